// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "dng_samples.h"
#include "dng_settings.h"

namespace srisp::plugin {

/// The writer of DNG files: a RAW-like result as a mosaic (one channel) or as LinearRaw (three), with its camera's
/// facts; any other image of three channels as what a neutral camera would have seen. Its options are attributes
/// (dng_settings.h). Samples are kept as integers of 16 bits until all are there; then the file is written at once: it
/// is complete or absent. That is not left to `close`, whose result many hosts do not look at. The file is the data
/// window.
class DngOutput final : public OIIO::ImageOutput {
public:
    const char* format_name() const override { return "dng"; }
    int supports(OIIO::string_view feature) const override;
    bool open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) override;
    bool close() override;
    /// A host's own place for the bytes, instead of a file.
    bool set_ioproxy(OIIO::Filesystem::IOProxy* proxy) override
    {
        m_proxy = proxy;
        return true;
    }
    bool write_scanline(int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride) override;

private:
    bool fail(const std::string& message);
    bool succeeds(const std::function<Status()>& step);
    Status begin(const std::string& name, const OIIO::ImageSpec& spec);
    Status finish();
    Expected<std::vector<std::string>> write_to_proxy(const DngImage& image);

    std::string m_path;
    OIIO::Filesystem::IOProxy* m_proxy = nullptr; ///< null: the file of that name
    DngSettings m_settings;
    std::optional<DngSamples> m_samples; ///< none: not open, or something failed
    bool m_is_written = false;           ///< as the samples are now
};

} // namespace srisp::plugin
