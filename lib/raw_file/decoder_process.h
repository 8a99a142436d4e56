// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <srisp/expected.h>

// RAW files are decoded by libraries that trust them. So this is done by a program of its own, srispdecode: what
// crashes or never ends there costs a message. It protects memory and time of the caller; it is no sandbox.

namespace srisp {

/// What the program can be asked for.
enum class DecoderTask {
    reference, ///< a reference (reference_bytes.h)
    noise,     ///< noise that is estimated from a RAW file (file_noise.h)
    preview,   ///< the JPEG picture that is embedded in a RAW file (embedded_preview.h)
    trial      ///< nothing but whether LibRaw decodes the file without harm
};

/// Starts the program, and waits for its answer: some bytes, none for `trial`. Errors, without the
/// file's name: what the program says of the file; it crashed, or took more time or memory than such a file can need;
/// it is not installed, or of another version. Threads: safe; nothing of the process is changed.
Expected<std::string> run_decoder(DecoderTask task, const std::string& path);

/// The error for an answer that is no such bytes: the program was misled by its file.
Error decoder_nonsense();

/// The main function of the program: limits itself, does the task, and writes the answer to stdout. Returns the exit
/// code.
int serve_decoder(int argc, char** argv,
                  const std::function<Expected<std::string>(DecoderTask task, const std::string& path)>& decode);

} // namespace srisp
