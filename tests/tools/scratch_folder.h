// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

/// A folder for one test, gone at its end.
class ScratchFolder {
public:
    ScratchFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "test-XXXXXX").string();
        m_path = mkdtemp(name.data());
    }
    ~ScratchFolder() { std::filesystem::remove_all(m_path); }
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
