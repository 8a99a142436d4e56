// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <srisp/srisp.h>

#include "base/guarded.h"
#include "base/installed_files.h"
#include "base/named_output.h"
#include "base/shown_reason.h"
#include "result/file_encoder.h"

namespace srisp {

namespace {

Status store(const std::string& path, const std::vector<unsigned char>& bytes)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    const bool stored =
        file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
    int error = stored ? 0 : errno;
    if (file && std::fclose(file) != 0 && error == 0)
        error = errno;
    return error == 0 ? Status() : Status(Error{ std::strerror(error) });
}

std::string reason_of(const std::string& told)
{
    const std::string reason = shown_reason(told);
    return reason.empty() ? "its writer does not say why" : reason;
}

Status write_file(OIIO::ImageOutput& output, const std::string& path, const OIIO::ImageSpec& spec, const float* pixels)
{
    if (output.open(path, spec) && output.write_image(OIIO::TypeFloat, pixels) && output.close())
        return {};
    return Error{ reason_of(output.geterror()) };
}

Error write_error(const std::string& path, const std::string& reason)
{
    return { "image '" + path + "' cannot be written: " + reason };
}

} // namespace

Status Image::save(const std::string& path, OIIO::TypeDesc type) const
{
    return guarded("image", path, [&]() -> Status {
        auto output = OIIO::ImageOutput::create(path, nullptr, plugins_beside());
        if (!output)
            return write_error(path, reason_of(OIIO::geterror()));
        NamedOutput file(path);
        Status written = file.created();
        if (written && output->supports("ioproxy")) {
            // OpenEXR's writer says nothing of a disk that gets full while it closes a file.
            const auto bytes = encode(path, type);
            if (!bytes)
                return bytes.error();
            written = store(file.name(), *bytes);
        } else if (written) {
            written = write_file(*output, file.name(), file_spec(*output, m_spec, type), m_pixels.data());
        }
        output.reset();
        if (written)
            written = file.finish();
        return written ? written : Status(write_error(path, written.error().message));
    });
}

Expected<std::vector<unsigned char>> Image::encode(const std::string& name, OIIO::TypeDesc type,
                                                   const std::string& compression) const
{
    return guarded("image", name, [&]() -> Expected<std::vector<unsigned char>> {
        auto encoder = FileEncoder::create(name);
        if (!encoder)
            return write_error(name, encoder.error().message);
        Status written = encoder->begin(m_spec, type, compression);
        if (written)
            written = encoder->add_rows(m_pixels.data(), m_spec.height);
        auto bytes = written ? encoder->finish() : Expected<std::vector<unsigned char>>(written.error());
        if (!bytes)
            return write_error(name, bytes.error().message);
        return bytes;
    });
}

} // namespace srisp
