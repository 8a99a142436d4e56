// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks what libsrisp exports; everything else is compiled with hidden symbols.
#define SRISP_API __attribute__((visibility("default")))
