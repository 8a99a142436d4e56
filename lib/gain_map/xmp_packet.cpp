// SPDX-License-Identifier: Apache-2.0
#include "gain_map/xmp_packet.h"

#include <cstring>
#include <utility>

#include <pugixml.hpp>

namespace srisp {

struct XmpPacket::Tree {
    pugi::xml_document document;

    /// A name as the packet writes it, with the prefix it gives to the namespace; "" where it lacks this. XMP has one
    /// prefix for a namespace in all of a packet.
    std::string written(const XmpName& name) const
    {
        std::string result;
        document.find_node([&](const pugi::xml_node& node) {
            for (const pugi::xml_attribute attribute : node.attributes())
                if (std::strncmp(attribute.name(), "xmlns:", 6) == 0 && std::strcmp(attribute.value(), name.space) == 0)
                    result = std::string(attribute.name() + 6) + ":" + name.name;
            return !result.empty();
        });
        return result;
    }
};

namespace {

/// The texts of a property's element: those of its rdf:li, or its own.
std::vector<std::string> texts(const pugi::xml_node& property)
{
    std::vector<std::string> result;
    for (const pugi::xml_node list : property.children())
        for (const pugi::xml_node item : list.children())
            if (item.type() == pugi::node_element)
                result.emplace_back(item.text().get());
    if (result.empty())
        result.emplace_back(property.text().get());
    return result;
}

/// As an attribute or a child of `node`.
std::vector<std::string> values_at(const pugi::xml_node& node, const std::string& written)
{
    if (written.empty())
        return {};
    if (const pugi::xml_attribute attribute = node.attribute(written.c_str()))
        return { attribute.value() };
    if (const pugi::xml_node child = node.child(written.c_str()))
        return texts(child);
    return {};
}

} // namespace

std::optional<XmpPacket> XmpPacket::parse(std::string_view packet)
{
    while (!packet.empty() && packet.back() == '\0')
        packet.remove_suffix(1);
    auto tree = std::make_shared<Tree>();
    if (!tree->document.load_buffer(packet.data(), packet.size()))
        return {};
    return XmpPacket(std::move(tree));
}

std::vector<std::string> XmpPacket::values(const XmpName& property) const
{
    const std::string written = m_tree->written(property);
    std::vector<std::string> result;
    m_tree->document.find_node([&](const pugi::xml_node& node) {
        result = values_at(node, written);
        return !result.empty();
    });
    return result;
}

std::vector<std::vector<std::string>> XmpPacket::structures(const XmpName& element,
                                                            const std::vector<XmpName>& fields) const
{
    const std::string written = m_tree->written(element);
    std::vector<std::string> written_fields;
    for (const XmpName& field : fields)
        written_fields.push_back(m_tree->written(field));
    std::vector<std::vector<std::string>> result;
    m_tree->document.find_node([&](const pugi::xml_node& node) {
        if (written.empty() || written != node.name())
            return false;
        std::vector<std::string> found;
        for (const std::string& field : written_fields) {
            const std::vector<std::string> texts = values_at(node, field);
            found.push_back(texts.empty() ? "" : texts.front());
        }
        result.push_back(std::move(found));
        return false;
    });
    return result;
}

} // namespace srisp
