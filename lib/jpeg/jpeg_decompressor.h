// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it

#include <jpeglib.h>

namespace srisp {

/// libjpeg's decompressor. libjpeg is C, which exceptions must not cross: an error jumps to where `setjmp(failed)` was
/// called, so between that and the end of decoding nothing may have a destructor. Closes itself.
struct JpegDecompressor {
    /// What to do about a warning; may call `fail`.
    using OnWarning = void (*)(JpegDecompressor& decompressor, int code);

    explicit JpegDecompressor(OnWarning on_warning);
    ~JpegDecompressor() { jpeg_destroy_decompress(&info); }
    JpegDecompressor(const JpegDecompressor&) = delete;
    JpegDecompressor& operator=(const JpegDecompressor&) = delete;

    /// Keeps what libjpeg says.
    void keep_message() { info.err->format_message(reinterpret_cast<j_common_ptr>(&info), message); }
    [[noreturn]] void fail();

    jpeg_decompress_struct info{};
    std::jmp_buf failed;
    char message[JMSG_LENGTH_MAX] = ""; ///< of the error, or the last that was kept

private:
    static JpegDecompressor& of(j_common_ptr common) { return *static_cast<JpegDecompressor*>(common->client_data); }

    jpeg_error_mgr m_errors{};
    OnWarning m_on_warning;
};

} // namespace srisp
