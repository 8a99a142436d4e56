// SPDX-License-Identifier: Apache-2.0
#include "color/icc_header.h"

#include <algorithm>
#include <string_view>

namespace srisp {

namespace {

constexpr std::size_t kHeaderBytes = 128, kTagBytes = 12;
constexpr std::uint32_t kMostTags = 100; // of Little CMS
constexpr std::uint32_t kIntents = 4;
constexpr std::uint32_t kPadding = 3; // some writers count it to the last tag and not to the profile

constexpr std::string_view kClasses[] = { "scnr", "mntr", "prtr", "link", "spac", "abst",
                                          "nmcl", "cenc", "mid ", "mlnk", "mvis" };
constexpr std::string_view kColorSpaces[] = { "XYZ ", "Lab ", "Luv ", "YCbr", "Yxy ", "RGB ", "GRAY", "HSV ", "HLS ",
                                              "CMYK", "CMY ", "1CLR", "2CLR", "3CLR", "4CLR", "5CLR", "6CLR", "7CLR",
                                              "8CLR", "9CLR", "ACLR", "BCLR", "CCLR", "DCLR", "ECLR", "FCLR", "MCH1",
                                              "MCH2", "MCH3", "MCH4", "MCH5", "MCH6", "MCH7", "MCH8", "MCH9", "MCHA",
                                              "MCHB", "MCHC", "MCHD", "MCHE", "MCHF" };

class Profile {
public:
    Profile(const void* data, std::size_t size) : m_bytes(static_cast<const char*>(data), size) {}

    std::size_t size() const { return m_bytes.size(); }
    std::uint32_t number(std::size_t at) const
    {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value << 8 | static_cast<unsigned char>(m_bytes[i]);
        return value;
    }
    template<class Names> bool is_one_of(const Names& names, std::size_t at) const
    {
        return std::find(std::begin(names), std::end(names), m_bytes.substr(at, 4)) != std::end(names);
    }
    std::string quoted(std::size_t at) const { return "'" + icc_signature_text(number(at)) + "'"; }

private:
    std::string_view m_bytes;
};

/// What is wrong; empty: nothing.
std::string header_fault(const Profile& profile)
{
    constexpr std::size_t kSizeAt = 0, kClassAt = 12, kSpaceAt = 16, kConnectionAt = 20, kMarkAt = 36, kIntentAt = 64;
    constexpr std::string_view kMark[] = { "acsp" };
    if (profile.size() < kHeaderBytes + 4)
        return "a header has " + std::to_string(kHeaderBytes + 4) + " bytes";
    if (!profile.is_one_of(kMark, kMarkAt))
        return "it does not say that it is one";
    if (profile.number(kSizeAt) > profile.size())
        return "it says that it has " + std::to_string(profile.number(kSizeAt));
    if (!profile.is_one_of(kClasses, kClassAt))
        return "no kind of profile is called " + profile.quoted(kClassAt);
    for (const std::size_t at : { kSpaceAt, kConnectionAt })
        if (!profile.is_one_of(kColorSpaces, at))
            return "no colour space is called " + profile.quoted(at);
    if (const std::uint32_t intent = profile.number(kIntentAt) & 0xffff; intent >= kIntents)
        return "its rendering intent is " + std::to_string(intent) + ", 0 to 3 are possible";
    return {};
}

std::string tags_fault(const Profile& profile)
{
    const std::uint32_t count = profile.number(kHeaderBytes);
    const std::size_t table = kHeaderBytes + 4;
    if (count > kMostTags || (profile.size() - table) / kTagBytes < count)
        return "it says that it has " + std::to_string(count) + " tags";
    for (std::size_t at = table; at < table + count * kTagBytes; at += kTagBytes) {
        const std::uint64_t end = std::uint64_t(profile.number(at + 4)) + profile.number(at + 8);
        if (end > profile.size() + kPadding)
            return "its tag " + profile.quoted(at) + " ends at byte " + std::to_string(end);
    }
    return {};
}

} // namespace

std::string icc_signature_text(std::uint32_t signature)
{
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) {
        const unsigned byte = signature >> shift & 0xff;
        text += byte >= ' ' && byte <= '~' ? static_cast<char>(byte) : '?';
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

Expected<IccHeader> read_icc_header(const void* data, std::size_t size)
{
    constexpr std::size_t kSpaceAt = 16;
    const Profile profile(data, size);
    std::string fault = header_fault(profile);
    if (fault.empty())
        fault = tags_fault(profile);
    if (!fault.empty())
        return Error{ "its ICC profile of " + std::to_string(size) + " bytes is damaged: " + fault };
    return IccHeader{ profile.number(kSpaceAt) };
}

} // namespace srisp
