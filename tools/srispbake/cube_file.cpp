// SPDX-License-Identifier: Apache-2.0
#include "cube_file.h"

#include <cstdio>

#include "../common/require.h"

namespace srisp::tool {

namespace OCIO = OCIO_NAMESPACE;

static std::string one_line(std::string text)
{
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == '"')
            c = ' ';
    return text;
}

CubeTable::CubeTable(const Chosen& chosen, Direction direction, int size) : m_size(size)
{
    for (int b = 0; b < size; ++b)
        for (int g = 0; g < size; ++g)
            for (int r = 0; r < size; ++r)
                for (const int i : { r, g, b })
                    m_rgb.push_back(float(i) / float(size - 1));
    const MutableImageView colors{ m_rgb.data(), size * size, size, 3, std::ptrdiff_t(3) * size * size };
    require(require(Applier::create(*chosen.model, chosen.parameters, direction))->run(colors, colors));
}

OCIO::ConstTransformRcPtr CubeTable::transform() const
{
    auto lut = OCIO::Lut3DTransform::Create(m_size);
    lut->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
    const float* rgb = m_rgb.data();
    for (int b = 0; b < m_size; ++b)
        for (int g = 0; g < m_size; ++g)
            for (int r = 0; r < m_size; ++r, rgb += 3)
                lut->setValue(r, g, b, rgb[0], rgb[1], rgb[2]);
    return lut;
}

std::string CubeTable::text(const std::string& title, const std::vector<std::string>& comments) const
{
    std::string text;
    for (const std::string& comment : comments)
        text += "# " + one_line(comment) + "\n";
    text += "TITLE \"" + one_line(title) + "\"\nLUT_3D_SIZE " + std::to_string(m_size) + "\n";
    char line[64];
    for (std::size_t i = 0; i < m_rgb.size(); i += 3) {
        std::snprintf(line, sizeof line, "%.7g %.7g %.7g\n", double(m_rgb[i]), double(m_rgb[i + 1]),
                      double(m_rgb[i + 2]));
        text += line;
    }
    return text;
}

} // namespace srisp::tool
