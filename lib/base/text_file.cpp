// SPDX-License-Identifier: Apache-2.0
#include "base/text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

Error failed(const std::string& path, const std::string& reason)
{
    return Error{ "'" + path + "': " + reason };
}

Error failed_call(const std::string& path)
{
    return failed(path, std::strerror(errno));
}

} // namespace

Expected<std::string> read_text_file(const std::string& path, std::size_t most)
{
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file)
        return failed_call(path);
    std::string text(most + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    if (std::ferror(file.get()))
        return failed_call(path);
    if (text.size() > most)
        return failed(path, "has more than " + std::to_string(most) + " bytes");
    return text;
}

Status write_text_file(const std::string& path, const std::string& text)
{
    const std::string temporary = path + ".tmp-" + std::to_string(::getpid());
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file)
        return failed_call(path);
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    // A full disk may show only here.
    const bool complete = std::fclose(file) == 0 && written;
    if (complete && std::rename(temporary.c_str(), path.c_str()) == 0)
        return {};
    const Error error = failed_call(path);
    std::remove(temporary.c_str());
    return error;
}

std::string file_state(const std::string& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0)
        return path;
    return path + "\n" + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino) + " " +
           std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) + " " +
           std::to_string(status.st_mtim.tv_nsec);
}

} // namespace srisp
