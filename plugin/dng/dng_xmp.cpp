// SPDX-License-Identifier: Apache-2.0
#include "dng_xmp.h"

#include "base/shown_text.h"
#include "record/record.h"

namespace srisp::plugin {

namespace {

std::string escaped(const std::string& text)
{
    std::string xml;
    for (const char c : valid_utf8(text)) {
        if (c == '&' || c == '<' || c == '>' || c == '"')
            xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&quot;";
        else
            xml += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return xml;
}

} // namespace

std::string xmp_of(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    if (!record)
        return {};
    std::string text = synthetic_mark(record->direction);
    if (const std::string reference = spec.get_string_attribute(attribute::kReference); !reference.empty())
        text += "; camera, exposure time, f-number and ISO are those of the reference " + reference;
    if (const std::string model = spec.get_string_attribute(attribute::kModel); !model.empty())
        text += "; model " + model;
    return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
           "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\"\n"
           " xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"\n"
           " xmlns:Iptc4xmpExt=\"http://iptc.org/std/Iptc4xmpExt/2008-02-29/\"\n"
           " xmp:CreatorTool=\"srisp " SRISP_VERSION "\"\n"
           " Iptc4xmpExt:DigitalSourceType="
           "\"http://cv.iptc.org/newscodes/digitalsourcetype/algorithmicallyEnhanced\">\n"
           "<dc:description><rdf:Alt><rdf:li xml:lang=\"x-default\">" +
           escaped(text) +
           "</rdf:li></rdf:Alt></dc:description>\n"
           "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>";
}

} // namespace srisp::plugin
