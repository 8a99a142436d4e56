// SPDX-License-Identifier: Apache-2.0
#include "report_page.h"

#include "base64.h"
#include "html_text.h"
#include "report_assets.h"
#include "report_charts.h"
#include "report_images.h"
#include "report_list.h"
#include "report_summary.h"
#include "report_words.h"

namespace srisp::tool {

namespace {

/// "'sha256-…'" of a script, for the page's own security policy.
std::string source_hash(const Asset& script)
{
    std::string bytes;
    for (std::size_t i = 0; i + 1 < script.sha256.size(); i += 2)
        bytes += char(std::stoi(std::string(script.sha256.substr(i, 2)), nullptr, 16));
    MemorySink digits;
    write_base64(digits, bytes);
    return "'sha256-" + digits.bytes() + "'";
}

/// The page runs these scripts and no others, and asks for nothing: whatever a file's name holds.
std::string security_policy()
{
    std::string scripts;
    for (const Asset& script : { report_sort_js(), report_pictures_js(), report_viewer_js() })
        scripts += " " + source_hash(script);
    return "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; "
           "script-src" +
           scripts;
}

void write_head(const Evaluation& evaluation, ByteSink& out)
{
    out.write("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
              "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
              security_policy() +
              "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
              "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
              report_title(evaluation) + "</title>\n<style>\n");
    out.write(std::string(report_css().text));
    out.write("</style>\n</head>\n<body>\n");
}

/// A section of the page and its place in the table of contents.
struct Section {
    const char *id, *title;
    std::string html; ///< empty: left out
};

void write_section_head(const Section& section, ByteSink& out)
{
    out.write(std::string("<section id=\"") + section.id + "\" aria-labelledby=\"" + section.id +
              "-title\">\n<h2 id=\"" + section.id + "-title\">" + section.title + "</h2>\n");
}

void write_section(const Section& section, ByteSink& out)
{
    if (section.html.empty())
        return;
    write_section_head(section, out);
    out.write(section.html);
    out.write("</section>\n");
}

void write_masthead(const Evaluation& evaluation, const std::vector<Section>& sections, ByteSink& out)
{
    out.write("<a class=\"skip\" href=\"#main\">Skip to the results</a>\n<header>\n<h1>" + report_title(evaluation) +
              "</h1>\n" + answer_html(evaluation) + "<nav aria-label=\"Contents\"><ul>\n");
    for (const Section& section : sections)
        if (!section.html.empty())
            out.write(std::string("<li><a href=\"#") + section.id + "\">" + section.title + "</a></li>\n");
    out.write("</ul></nav>\n</header>\n");
}

void write_scripts(ByteSink& out)
{
    out.write(std::string(report_viewer_html().text));
    for (const Asset& script : { report_sort_js(), report_pictures_js(), report_viewer_js() })
        out.write("<script>" + std::string(script.text) + "</script>\n");
}

} // namespace

Status write_report(const Evaluation& evaluation, const std::vector<std::size_t>& shown,
                    const std::function<Expected<ImagePictures>(std::size_t)>& pictures, ByteSink& out)
{
    const std::vector<Section> before{ { "summary", "Summary", summary_html(evaluation) },
                                       { "cameras", "By camera", camera_tables_html(evaluation) },
                                       { "charts", "Charts", charts_html(evaluation) } };
    const Section images{ "images", "Images", image_table_html(evaluation, shown) },
        how{ "how", "How it was measured", protocol_html(evaluation) };
    std::vector<Section> all = before;
    all.push_back(images);
    all.push_back(how);
    write_head(evaluation, out);
    write_masthead(evaluation, all, out);
    out.write("<main id=\"main\">\n");
    for (const Section& section : before)
        write_section(section, out);
    write_section_head(images, out);
    out.write(images.html);
    write_images(evaluation, shown, pictures, out);
    out.write("</section>\n");
    write_section(how, out);
    out.write("</main>\n<footer><p>srisp " + html(evaluation.version) + "</p></footer>\n");
    write_scripts(out);
    out.write("</body>\n</html>\n");
    return out.good() ? Status() : Status(Error{ "the report cannot be written" });
}

} // namespace srisp::tool
