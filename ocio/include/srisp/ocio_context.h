// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <srisp/apply.h>
#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

/// The transform that context variables ask for, for hosts that link this library: no bake, no file.
///   SRISP_REFERENCE  the RAW file, a path or a name in the config's search path; `srisp_neutral` (what our config
///                    declares) means none: the sRGB curve alone
///   SRISP_SOURCE     the photo that parameters are chosen for; empty: the reference's neutral rendition
///   SRISP_MODEL      name or path of a model with kernel size 1; empty: `default`
/// `direction`: reverse ("unprocess") or forward ("process"). The config's own context is taken where `context` is
/// null. What was made is kept for the whole process (a bounded number), by the content of the files: the same files
/// under other names give the same transform, a changed file gives a new one. The result is shared: copy it before
/// changing it. Threads: safe. Errors: no config; SRISP_REFERENCE not set or not found; what reference, photo and model
/// can lack.
SRISP_API Expected<OCIO_NAMESPACE::ConstGroupTransformRcPtr>
transform_from_context(const OCIO_NAMESPACE::ConstConfigRcPtr& config,
                       const OCIO_NAMESPACE::ConstContextRcPtr& context = {}, Direction direction = Direction::reverse);

} // namespace srisp
