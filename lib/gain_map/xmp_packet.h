// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace srisp {

/// A property of XMP: the namespace (files choose its prefix), and the name in it.
struct XmpName {
    const char* space;
    const char* name;
};

/// The properties of a packet of XMP. Immutable.
class XmpPacket {
public:
    /// None: it is not XML, or damaged.
    static std::optional<XmpPacket> parse(std::string_view packet);

    /// What a property says, written as attribute or as element: one text, or those of its list; empty: absent.
    std::vector<std::string> values(const XmpName& property) const;

    /// The elements of a name in their order, each as the text of `fields` ("" for one that it lacks).
    std::vector<std::vector<std::string>> structures(const XmpName& element, const std::vector<XmpName>& fields) const;

private:
    struct Tree;
    explicit XmpPacket(std::shared_ptr<const Tree> tree) : m_tree(std::move(tree)) {}
    std::shared_ptr<const Tree> m_tree;
};

} // namespace srisp
