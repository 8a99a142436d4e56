// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <memory>

#include <libheif/heif.h>

#include "container/file_description.h"

namespace srisp {

namespace {

struct Deleter {
    void operator()(heif_context* context) const { heif_context_free(context); }
    void operator()(heif_image_handle* handle) const { heif_image_handle_release(handle); }
    void operator()(heif_color_profile_nclx* profile) const { heif_nclx_color_profile_free(profile); }
};
template<class T> using Owned = std::unique_ptr<T, Deleter>;

bool failed(const heif_error& error)
{
    return error.code != heif_error_Ok;
}

/// The ICC profile where there is one: nclx is then for the codec alone [ISO/IEC 23000-22].
void describe_color(const heif_image_handle* handle, OIIO::ImageSpec& spec)
{
    if (const std::size_t size = heif_image_handle_get_raw_color_profile_size(handle)) {
        std::vector<unsigned char> profile(size);
        if (!failed(heif_image_handle_get_raw_color_profile(handle, profile.data()))) {
            set_icc_profile(spec, profile.data(), size);
            return;
        }
    }
    heif_color_profile_nclx* found = nullptr;
    if (failed(heif_image_handle_get_nclx_color_profile(handle, &found)) || !found)
        return;
    const Owned<heif_color_profile_nclx> nclx(found);
    set_cicp(spec, { int(nclx->color_primaries), int(nclx->transfer_characteristics), int(nclx->matrix_coefficients),
                     int(nclx->full_range_flag) });
}

/// Whether the file says how to turn its picture, which readers then have done (irot and imir).
bool has_turning_boxes(const std::string& path)
{
    constexpr std::size_t kMostBytes = 1 << 20; // they lie in the head
    std::string head(kMostBytes, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    head.resize(std::min(head.find("mdat"), head.size()));
    return head.find("irot") != std::string::npos || head.find("imir") != std::string::npos;
}

/// A TIFF structure; empty: there is none.
std::string exif_of(const heif_image_handle* handle)
{
    heif_item_id id = 0;
    if (heif_image_handle_get_list_of_metadata_block_IDs(handle, "Exif", &id, 1) < 1)
        return {};
    std::string block(heif_image_handle_get_metadata_size(handle, id), '\0');
    if (block.size() < 4 || failed(heif_image_handle_get_metadata(handle, id, block.data())))
        return {};
    // Four bytes say how many follow before it ("Exif\0\0").
    std::size_t offset = 0;
    for (int i = 0; i < 4; ++i)
        offset = offset << 8 | static_cast<unsigned char>(block[i]);
    return offset < block.size() - 4 ? block.substr(offset + 4) : "";
}

/// The boxes of the container hold, and cameras leave the EXIF tag as it was; it counts where there are none.
void describe_orientation(const heif_image_handle* handle, const std::string& path, OIIO::ImageSpec& spec)
{
    const std::string exif = exif_of(handle);
    if (exif.empty())
        return;
    spec.erase_attribute("Orientation");
    add_exif(spec, exif.data(), exif.size());
    if (has_turning_boxes(path))
        spec.attribute("Orientation", 1);
}

void note_other_images(heif_context* context, const heif_image_handle* handle, OIIO::ImageSpec& spec)
{
    if (const int count = heif_context_get_number_of_top_level_images(context); count > 1)
        add_note(spec, "holds " + std::to_string(count) + " pictures; the first was taken");
    constexpr int kMost = 16;
    heif_item_id ids[kMost];
    const int count = heif_image_handle_get_list_of_auxiliary_image_IDs(
        handle, LIBHEIF_AUX_IMAGE_FILTER_OMIT_ALPHA | LIBHEIF_AUX_IMAGE_FILTER_OMIT_DEPTH, ids, kMost);
    for (int i = 0; i < count; ++i) {
        heif_image_handle* found = nullptr;
        if (failed(heif_image_handle_get_auxiliary_image_handle(handle, ids[i], &found)))
            continue;
        const Owned<heif_image_handle> auxiliary(found);
        const char* type = nullptr;
        if (failed(heif_image_handle_get_auxiliary_type(found, &type)) || !type)
            continue;
        if (std::string(type).find("hdrgainmap") != std::string::npos)
            add_note(spec,
                     "holds a gain map (Apple HDR), which was not applied: the picture's SDR rendition was taken");
        heif_image_handle_free_auxiliary_types(found, &type);
    }
}

} // namespace

void describe_heif(const std::string& path, OIIO::ImageSpec& spec)
{
    const Owned<heif_context> context(heif_context_alloc());
    if (failed(heif_context_read_from_file(context.get(), path.c_str(), nullptr)))
        return;
    heif_image_handle* found = nullptr;
    if (failed(heif_context_get_primary_image_handle(context.get(), &found)))
        return;
    const Owned<heif_image_handle> handle(found);
    describe_color(found, spec);
    describe_orientation(found, path, spec);
    note_other_images(context.get(), found, spec);
    if (heif_image_handle_is_premultiplied_alpha(found))
        spec.attribute("oiio:UnassociatedAlpha", 0);
}

} // namespace srisp
