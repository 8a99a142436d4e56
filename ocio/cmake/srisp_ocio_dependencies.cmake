# SPDX-License-Identifier: Apache-2.0
# OpenColorIO, as the build and the installed package need it. Debian keeps its package files where CMake does not look.
find_package(OpenColorIO 2.1 CONFIG REQUIRED HINTS /usr/share/cmake)
srisp_drop_missing_includes(OpenColorIO::OpenColorIO)
