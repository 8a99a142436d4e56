// SPDX-License-Identifier: Apache-2.0
#include "jpeg/jpeg_decompressor.h"

namespace srisp {

JpegDecompressor::JpegDecompressor(OnWarning on_warning) : m_on_warning(on_warning)
{
    info.err = jpeg_std_error(&m_errors);
    info.client_data = this;
    m_errors.error_exit = [](j_common_ptr common) { of(common).fail(); };
    m_errors.emit_message = [](j_common_ptr common, int level) {
        if (level < 0) // others trace what it does
            of(common).m_on_warning(of(common), common->err->msg_code);
    };
    m_errors.output_message = [](j_common_ptr) {};
}

void JpegDecompressor::fail()
{
    keep_message();
    std::longjmp(failed, 1);
}

} // namespace srisp
