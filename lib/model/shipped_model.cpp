// SPDX-License-Identifier: Apache-2.0
#include "model/shipped_model.h"

#include <filesystem>

#include <openssl/sha.h>

#include "base/installed_files.h"
#include "base/printed.h"
#include "shipped_hashes.h"

namespace srisp {

static std::string sha256(const std::string& bytes)
{
    unsigned char digest[SHA256_DIGEST_LENGTH];
    SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
    std::string text;
    for (const unsigned char byte : digest)
        text += printed("%02x", unsigned(byte));
    return text;
}

Status check_shipped_model(const std::string& name_or_path, const std::string& path, const std::string& bytes)
{
    const std::filesystem::path installed = shared_folder("models");
    for (const auto& [name, expected] : kShippedHashes) {
        if (name_or_path != name || installed.empty() || path != installed / (name_or_path + ".safetensors"))
            continue;
        if (const std::string hash = sha256(bytes); hash != expected)
            return Error{ "is not the file that ships under this name: its SHA-256 is " + hash + ", expected " +
                          expected +
                          "; install srisp anew, or put a model of yours into a folder of SRISP_MODEL_PATH" };
    }
    return {};
}

} // namespace srisp
