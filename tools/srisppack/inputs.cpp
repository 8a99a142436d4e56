// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <algorithm>
#include <filesystem>

#include <OpenImageIO/strutil.h>

#include "../common/failure.h"
#include "base/file_bytes.h"
#include "base/hashes.h"
#include "base/regular_file.h"
#include "camera_folder.h"
#include "container/file_type.h"
#include "container/reader_name.h"
#include "recipe/reference_pattern.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLeastWithValidation = 5; // fewer are all needed for training

enum class Kind { photo, raw, set, other };
enum class Role { recognise, photos, raws };

std::string extension_of(const std::string& path)
{
    const std::string extension = OIIO::Strutil::lower(fs::path(path).extension().string());
    return extension.empty() ? extension : extension.substr(1);
}

/// Whether a name is one of a still image that OpenImageIO reads.
bool has_image_extension(const std::string& path)
{
    const std::vector<std::string> excluded = { "", "ffmpeg", "raw", "null", "socket", "term", "srisp", "openvdb" };
    return std::find(excluded.begin(), excluded.end(), reader_of_ending(path)) == excluded.end();
}

Kind kind_of(const std::string& path, Role role)
{
    if (extension_of(path) == "safetensors")
        return role == Role::photos ? Kind::other : Kind::set;
    if (has_raw_extension(path))
        return role == Role::photos ? Kind::other : Kind::raw;
    const auto head = read_head(path, kHeadBytes);
    const FileKind kind = head ? file_type(*head).kind : FileKind::headerless;
    // A file that is damaged from its first byte on is still meant to be the image that it is called.
    const bool unnamed = kind == FileKind::raw || kind == FileKind::foveon || kind == FileKind::headerless;
    const bool image = !unnamed || has_image_extension(path);
    const bool linear = kind == FileKind::exr || kind == FileKind::tiff;
    if (role == Role::raws)
        return linear ? Kind::raw : Kind::other;
    return image ? Kind::photo : Kind::other;
}

/// Sorts files into `inputs`.
class Finder {
public:
    Finder(const PackOptions& options, Inputs& inputs) : m_options(options), m_inputs(inputs) {}

    void add(const std::string& input, Role role)
    {
        std::error_code error;
        if (is_url(input))
            fail("input '" + input + "' " + kIsUrl);
        if (!fs::exists(input, error))
            fail("input '" + input + "' does not exist");
        if (!fs::is_directory(input, error)) {
            const fs::path path = input;
            const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
            add_file(folder, path.filename().string(), Manifest::of_folder(folder), role);
            return;
        }
        if (role == Role::recognise && is_camera_folder(input))
            return add_cameras(input);
        add_folder(input, role);
    }

    void add_cameras(const std::string& folder)
    {
        if (!m_inputs.cameras.empty())
            fail_usage("two folders of cameras: '" + m_inputs.cameras + "' and '" + folder + "'");
        m_inputs.cameras = folder;
    }

private:
    void add_folder(const std::string& folder, Role role)
    {
        const Manifest manifest = Manifest::of_folder(folder);
        std::vector<std::string> names;
        std::error_code error;
        for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            const bool hidden = entry->path().filename().string()[0] == '.';
            std::error_code ignored;
            if (hidden && entry->is_directory(ignored))
                entry.disable_recursion_pending();
            if (!hidden && entry->is_regular_file(ignored))
                names.push_back(entry->path().lexically_relative(folder).string());
        }
        if (error)
            fail("input '" + folder + "' cannot be listed: " + error.message());
        // What a manifest lists and is not there is told when it is read.
        for (const auto& [name, provenance] : manifest.files())
            names.push_back(name);
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        for (const std::string& name : names)
            if (name != "manifest.csv")
                add_file(folder, name, manifest, role);
    }

    void add_file(const std::string& folder, const std::string& name, const Manifest& manifest, Role role)
    {
        ImageInput image{ (fs::path(folder) / name).string(), name, manifest.of(name) };
        const Kind kind = kind_of(image.path, role);
        if (kind == Kind::other)
            ++m_inputs.other_files;
        else if (manifest.present() && manifest.files().count(name) == 0)
            ++m_inputs.not_in_manifest;
        else if (m_options.open_only && !image.provenance.open)
            ++m_inputs.not_open;
        else
            (kind == Kind::photo ? m_inputs.photos
             : kind == Kind::raw ? m_inputs.raws
                                 : m_inputs.sets)
                .push_back(std::move(image));
    }

    const PackOptions& m_options;
    Inputs& m_inputs;
};

/// Where a hash of names leaves no image of a small folder for validation, the one with the lowest hash is.
void choose_one_for_validation(std::vector<ImageInput>& images)
{
    const auto chosen = [](const ImageInput& image) { return image.provenance.listed || image.provenance.validation; };
    if (images.size() < kLeastWithValidation || std::any_of(images.begin(), images.end(), chosen))
        return;
    const auto hash = [](const ImageInput& image) { return seeded_hash(0, image.name); };
    std::min_element(images.begin(), images.end(), [&](const ImageInput& a, const ImageInput& b) {
        return hash(a) < hash(b);
    })->provenance.validation = true;
}

} // namespace

Inputs find_inputs(const PackOptions& options)
{
    Inputs inputs;
    Finder finder(options, inputs);
    for (const std::string& input : options.inputs)
        finder.add(input, Role::recognise);
    for (const std::string& input : options.photos)
        finder.add(input, Role::photos);
    for (const std::string& input : options.raws)
        finder.add(input, Role::raws);
    for (const std::string& folder : options.cameras) {
        if (!is_camera_folder(folder))
            fail("input '" + folder + "' is not a folder of cameras: it has no folder 'sensitivities'");
        finder.add_cameras(folder);
    }
    choose_one_for_validation(inputs.photos);
    choose_one_for_validation(inputs.raws);
    if (inputs.photos.empty() && inputs.raws.empty() && inputs.sets.empty() && inputs.cameras.empty()) {
        std::string why = "the inputs hold no photos, RAW files or cameras";
        if (inputs.not_open > 0)
            why = "--open-only leaves no image: " + std::to_string(inputs.not_open) +
                  " are not called open in a manifest.csv";
        else if (inputs.not_in_manifest > 0)
            why = "manifest.csv lists none of the " + std::to_string(inputs.not_in_manifest) + " images";
        fail(why);
    }
    return inputs;
}

} // namespace srisp::tool
