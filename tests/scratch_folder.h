// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

/// A folder of its own for a test's files, removed with all that is in it at its end.
class ScratchFolder {
public:
    ScratchFolder()
    {
        m_path = (std::filesystem::temp_directory_path() / "srisp-test-XXXXXX").string();
        if (!mkdtemp(m_path.data()))
            throw std::runtime_error("cannot make a folder for test files: " + m_path);
    }
    ~ScratchFolder()
    {
        std::error_code error;
        std::filesystem::remove_all(m_path, error);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string path(const std::string& name = "") const { return name.empty() ? m_path : m_path + "/" + name; }
    /// Makes a file, and returns its path.
    std::string file(const std::string& name, const std::string& content = "x") const
    {
        std::ofstream(path(name)) << content;
        return path(name);
    }

private:
    std::string m_path;
};

/// What a shell command prints on stdout and stderr.
inline std::string output_of(const std::string& command)
{
    std::string text;
    FILE* pipe = popen(("exec 2>&1; " + command).c_str(), "r");
    for (int c; pipe && (c = std::getc(pipe)) != EOF;)
        text += char(c);
    if (pipe)
        pclose(pipe);
    return text;
}
