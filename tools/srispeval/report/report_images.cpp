// SPDX-License-Identifier: Apache-2.0
#include "report_images.h"

#include <cmath>

#include "base/printed.h"
#include "base64.h"
#include "html_text.h"
#include "image_details.h"
#include "report_list.h"
#include "report_words.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kWorst = 10; ///< that have a heading of their own

template<class Numbers> std::string list(const Numbers& numbers)
{
    std::string text;
    for (const double one : numbers)
        text += (text.empty() ? "" : " ") + printed("%.7g", std::isfinite(one) ? one : 0.0);
    return text;
}

/// Balance and matrix as one, for feColorMatrix: rows of R, G, B, A, 1.
std::string matrix_values(const ImagePictures& pictures)
{
    std::array<double, 20> values{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t channel = 0; channel < 3; ++channel)
            values[row * 5 + channel] = double(pictures.color[row * 3 + channel]) * pictures.white_balance[channel];
    values[18] = 1;
    return list(values);
}

/// Makes linear camera RGB look like a photo where no script runs: balance, matrix, and sRGB's curve but for its foot.
std::string filter(const ImagePictures& pictures, const std::string& anchor)
{
    std::string text = "<svg class=\"filter\" width=\"0\" height=\"0\" aria-hidden=\"true\"><filter id=\"develop-" +
                       anchor +
                       "\" color-interpolation-filters=\"sRGB\" x=\"0\" y=\"0\" width=\"1\" height=\"1\">"
                       "<feColorMatrix values=\"" +
                       matrix_values(pictures) + "\"/><feComponentTransfer>";
    for (const char* channel : { "R", "G", "B" })
        text += std::string("<feFunc") + channel +
                " type=\"gamma\" amplitude=\"1.055\" exponent=\"0.41667\" offset=\"-0.055\"/>";
    return text + "</feComponentTransfer></filter></svg>\n";
}

/// One picture: what it is, how it is called, its bytes.
struct Picture {
    std::string kind, name, caption;
    const std::string& bytes;
    int width, height;
    bool linear;
};

void write_picture(const Picture& picture, const std::string& title, const std::string& anchor, ByteSink& out)
{
    if (picture.bytes.empty() || picture.width <= 0 || picture.height <= 0)
        return;
    const std::string width = std::to_string(picture.width), height = std::to_string(picture.height);
    // A row that is half cut off keeps the file's lower half, noise to the eye, from shining through where it is
    // scaled.
    out.write("<figure data-kind=\"" + picture.kind + "\" data-name=\"" + html(picture.name) + "\" data-width=\"" +
              width + "\" data-height=\"" + height + "\"><div class=\"crop\" style=\"aspect-ratio:" + width + "/" +
              coordinate(picture.height - 0.5) + "\"><img decoding=\"async\" width=\"" + width + "\" height=\"" +
              std::to_string(picture.linear ? picture.height * 2 : picture.height) + "\" alt=\"" + html(picture.name) +
              " of " + title + "\"" +
              (picture.linear ? " class=\"linear\" style=\"filter:url(#develop-" + anchor + ")\"" : "") +
              " src=\"data:image/" + (picture.linear ? "png" : "jpeg") + ";base64,");
    write_base64(out, picture.bytes);
    out.write("\"></div><figcaption>" + html(picture.caption) + "</figcaption></figure>\n");
}

void write_pictures(const Evaluation& evaluation, const ImageScore& image, const ImagePictures& pictures,
                    const std::string& anchor, ByteSink& out)
{
    const std::string title = image_title(image);
    const int width = pictures.width, height = pictures.height;
    out.write(filter(pictures, anchor) + "<div class=\"pictures\">\n");
    write_picture({ "reference", "reference", "reference: " + image.reference, pictures.reference,
                    pictures.reference_width, pictures.reference_height, true },
                  title, anchor, out);
    write_picture({ "photo", "photo", "photo", pictures.photo, width, height, false }, title, anchor, out);
    write_picture({ "truth", "truth", "truth", pictures.truth, width, height, true }, title, anchor, out);
    for (const std::string& method : evaluation.methods) {
        const auto result = pictures.results.find(method);
        if (result != pictures.results.end())
            write_picture({ "result", method, method, result->second, width, height, true }, title, anchor, out);
    }
    out.write("</div>\n");
}

void write_image(const Evaluation& evaluation, std::size_t index, std::size_t rank,
                 const Expected<ImagePictures>& pictures, ByteSink& out)
{
    const ImageScore& image = evaluation.images[index];
    const std::string anchor = picture_anchor(index);
    out.write("<article class=\"image\" id=\"" + anchor + "\" aria-labelledby=\"title-" + anchor + "\"");
    if (pictures)
        out.write(" data-balance=\"" + list(pictures->white_balance) + "\" data-color=\"" + list(pictures->color) +
                  "\"");
    out.write(">\n<h4 id=\"title-" + anchor + "\"><span class=\"rank\">" + std::to_string(rank) +
              "</span> <span class=\"title\">" + image_title(image) + "</span> <small>" +
              rendering_title(image.rendering) + ", " + html(image.camera) + ", measured on " +
              std::to_string(image.width) + " × " + std::to_string(image.height) + " pixels</small></h4>\n");
    if (pictures)
        write_pictures(evaluation, image, *pictures, anchor, out);
    else
        out.write("<p class=\"warning\">Its pictures cannot be shown: " + html(pictures.error().message) + "</p>\n");
    out.write(image_details_html(evaluation, image));
    out.write("</article>\n");
}

} // namespace

void write_images(const Evaluation& evaluation, const std::vector<std::size_t>& shown,
                  const std::function<Expected<ImagePictures>(std::size_t)>& pictures, ByteSink& out)
{
    for (std::size_t i = 0; i < shown.size() && out.good(); ++i) {
        if (i == 0)
            out.write(shown.size() > kWorst ? "<h3>The worst ten</h3>\n" : "<h3>The worst first</h3>\n");
        if (i == kWorst)
            out.write("<h3>Further images</h3>\n");
        write_image(evaluation, shown[i], i + 1, pictures(shown[i]), out);
    }
}

} // namespace srisp::tool
