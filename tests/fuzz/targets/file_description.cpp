// SPDX-License-Identifier: Apache-2.0
// What image files say beside their pixels: PNG, PSD, BMP, HEIF and WebP, sizes in headers, DNGs of our own.
#include "container/file_description.h"

#include "base/png_orientation.h"
#include "color/color_reading.h"
#include "container/own_dng.h"
#include "container/reader_name.h"
#include "container/size_in_header.h"
#include "memory_file.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    const std::string path = file.holding(data, size);
    for (const auto describe : { describe_png, describe_bmp, describe_psd }) {
        OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeUInt8);
        describe(path, spec);
        for (const std::string& note : note_list(spec))
            fuzz::check_message(note);
        const ColorReading reading = read_as_described(spec, 3);
        for (const std::string& note : reading.notes)
            fuzz::check_message(note);
    }
    for (const char* reader : { "gif", "heif", "jpeg", "jpeg2000" })
        fuzz::is_accepted(check_header(reader, path));
    fuzz::is_accepted(find_own_dng(path, true));
    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeUInt8);
    add_exif(spec, data, size);
    std::vector<unsigned char> bytes(data, data + size);
    place_png_orientation(bytes);
    fuzz::must_hold(bytes.size() == size, "an orientation takes no room");
    return 0;
}
