// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>

namespace srisp {

/// A camera in a light, as one image showed it.
struct Reference {
    std::string name; ///< base name of the file
    std::string path;
    std::string hash;    ///< "xxh128:" and 32 hex digits, of the file's bytes (plain samples: and their description's)
    Thumbnail thumbnail; ///< linear camera RGB in [0,1], upright
    CameraFacts facts;
    std::vector<std::string> notes; ///< what was ignored or assumed, one sentence each
};

/// Decodes a reference: any RAW file that LibRaw decodes to RGB; lossy DNGs; plain samples without a header that a JSON
/// file beside them describes (docs/usage.md); an EXR or TIFF that srisp wrote; or any float EXR,
/// which is taken as camera RGB in [0,1]. Black is subtracted per CFA position, divided by (white − black), clipped to
/// [0,1]; the thumbnail needs no demosaicing. Threads: safe. Refused, each with its own message: display-encoded
/// images, filters of other than three colours, Foveon, monochrome, X-Trans where LibRaw does not decode it, files
/// that LibRaw would know by their size alone, black frames (98th percentile below 0.005), truncated files, empty
/// areas. [P 4.2; DNG 1.4]
/// `isolate`: RAW files are decoded by a program of their own, srispdecode, so that one that is damaged, or made to do
/// harm, crashes or delays that and not the caller; some 10 to 30 ms more (docs/performance.md).
SRISP_API Expected<std::shared_ptr<const Reference>> load_reference(const std::string& path, bool isolate = true);

/// Chooses one file where `pattern` names several: a folder, a glob, or a list (`a.dng;b.dng`); a plain file is itself,
/// and so is any name that exists. The choice depends on `seed` and `photo_name` only (the base name is used), not on
/// the order in which photos come.
SRISP_API Expected<std::string> choose_reference(const std::string& pattern, std::uint64_t seed,
                                                 const std::string& photo_name);
/// The same for a list of files, folders and globs, in which ';' parts nothing.
SRISP_API Expected<std::string> choose_reference(const std::vector<std::string>& patterns, std::uint64_t seed,
                                                 const std::string& photo_name);

/// All files that `load_reference` may read for `path`: it, and the names of JSON files that would describe its
/// samples.
SRISP_API std::vector<std::string> reference_files(const std::string& path);

/// Path and state (inode, size, modification time in ns) of all files that `load_reference` reads for `path`: a key for
/// what was made of it.
SRISP_API std::string reference_state(const std::string& path);

/// `load_reference` with a cache for the whole process: key is the reference's state.
SRISP_API Expected<std::shared_ptr<const Reference>> load_reference_cached(const std::string& path,
                                                                           bool isolate = true);

} // namespace srisp
