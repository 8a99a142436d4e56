// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

/// All of a literal, its zero bytes too.
template<std::size_t Size> std::string literal(const char (&text)[Size])
{
    return { text, Size - 1 };
}

/// Where make_fuzz_seeds puts its files: FOLDER/TARGET/NAME.
class SeedFolder {
public:
    explicit SeedFolder(const std::string& path) : m_path(path) {}

    void add(const std::string& target, const std::string& name, const std::string& bytes) const
    {
        std::filesystem::create_directories(m_path / target);
        std::ofstream(m_path / target / name, std::ios::binary) << bytes;
    }

private:
    std::filesystem::path m_path;
};

/// Files of RAW formats and their like, and what decodes them.
void make_raw_seeds(const SeedFolder& seeds);
/// Image files and what lies in them.
void make_image_seeds(const SeedFolder& seeds);
