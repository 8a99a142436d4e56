// SPDX-License-Identifier: Apache-2.0
// What an image's description says of its making: the record's line, and what stands in it.
#include <srisp/develop.h>
#include <srisp/metadata.h>

#include "fuzz_target.h"
#include "record/record.h"

using namespace srisp;

namespace {

void check_development(const std::string& text)
{
    const auto development = development_from_json(text, "file");
    if (!fuzz::is_accepted(development))
        return;
    const auto again = development_from_json(to_json(*development), "file");
    fuzz::must_hold(again && to_json(*again) == to_json(*development), "a development comes back to the bit");
    std::vector<float> rgb{ 0, 0.5f, 1, 0.2f, 0.9f, 0.1f };
    const MutableImageView image{ rgb.data(), 2, 1, 3, 6 };
    fuzz::is_accepted(develop(*development, image, image, nullptr, 1));
    fuzz::is_accepted(undo_development(*development, image, image, 1));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text = fuzz::text_of(data, size);
    check_development(text);
    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeFloat);
    spec.attribute("ImageDescription", text);
    fuzz::is_accepted(recorded_parameters(spec, "image"));
    recorded_cfa_pattern(spec);
    recorded_sensor_values(spec);
    check_development(recorded_development(spec));
    recorded_space(spec);
    recorded_camera(spec);
    recorded_sensor(spec);
    if (const auto record = find_record(text)) {
        const std::string line = format_record(*record);
        const auto again = find_record("before " + line + " after");
        fuzz::must_hold(bool(again), "what was written is found", line);
        fuzz::must_hold(format_record(*again) == line, "a record comes back as it was", line);
    }
    record_sensor_values(spec, recorded_sensor_values(spec));
    mark_result(spec, Direction::reverse);
    fuzz::must_hold(is_unprocessed(spec), "a result says what it is");
    return 0;
}
