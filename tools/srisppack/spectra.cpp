// SPDX-License-Identifier: Apache-2.0
#include "spectra.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../common/csv_table.h"
#include "../common/failure.h"
#include "base/input_file.h"
#include "base/json_object.h"
#include "base/matrix3.h"
#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp::tool {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = 1 << 26;
constexpr std::size_t kMaxColumns = 10000;

double as_number(const std::string& text, const std::string& where)
{
    const auto value = lenient_number<double>(text);
    if (!value)
        fail(where + ": '" + shown_text(text) + "' is not a finite number");
    return *value;
}

/// Puts the rows in order and checks what both formats must keep.
SpectraTable from_rows(SpectraTable table, const std::map<double, std::vector<double>>& rows)
{
    if (table.columns.size() > kMaxColumns)
        fail(table.where + " has " + std::to_string(table.columns.size()) + " columns, limit " +
             std::to_string(kMaxColumns));
    if (table.columns.empty() || rows.empty())
        fail(table.where + " holds no spectra");
    if (rows.begin()->first > 400 || rows.rbegin()->first < 700)
        fail(table.where + " covers " + std::to_string(int(rows.begin()->first)) + " to " +
             std::to_string(int(rows.rbegin()->first)) + " nm, 400 to 700 are needed");
    table.values.resize(table.columns.size());
    for (const auto& [wavelength, values] : rows) {
        if (values.size() != table.columns.size())
            fail(table.where + ", " + std::to_string(wavelength) + " nm: has " + std::to_string(values.size()) +
                 " numbers, needs " + std::to_string(table.columns.size()));
        table.wavelengths_nm.push_back(wavelength);
        for (std::size_t column = 0; column < values.size(); ++column)
            table.values[column].push_back(values[column]);
    }
    return table;
}

std::string text_of(const json& header, const char* key)
{
    return header.is_object() && header.contains(key) && header[key].is_string() ? header[key].get<std::string>()
                                                                                 : std::string();
}

} // namespace

SpectraTable read_spectra_json(const std::string& path)
{
    SpectraTable table;
    table.where = "'" + path + "'";
    const Expected<std::string> text = read_text_file(path, kMaxBytes);
    if (!text)
        fail(text.error().message);
    const Expected<json> file = parse_json_object(*text, table.where, "file", kMaxBytes);
    if (!file)
        fail(file.error().message);
    const json header = file->value("header", json::object());
    table.manufacturer = text_of(header, "manufacturer");
    table.model = text_of(header, "model");
    table.licence = text_of(header, "license");
    const json columns = file->value("/spectral_data/index/main"_json_pointer, json());
    const json data = file->value("/spectral_data/data/main"_json_pointer, json());
    if (!columns.is_array() || !data.is_object())
        fail(table.where + " has no spectral_data with index and data");
    for (const json& column : columns)
        table.columns.push_back(column.is_string() ? column.get<std::string>() : shown_json(column));
    std::map<double, std::vector<double>> rows;
    for (const auto& [wavelength, values] : data.items()) {
        std::vector<double>& row = rows[as_number(wavelength, table.where)];
        for (const json& value : values) {
            if (!value.is_number() || !std::isfinite(value.get<double>()))
                fail(table.where + ", " + shown_text(wavelength) + " nm: " + shown_json(value) +
                     " is not a finite number");
            row.push_back(value.get<double>());
        }
    }
    return from_rows(std::move(table), rows);
}

SpectraTable read_spectra_csv(const std::string& path)
{
    const CsvTable csv = read_csv(path);
    SpectraTable table;
    table.where = "'" + path + "'";
    if (csv.columns.empty() || csv.columns[0] != "wavelength_nm")
        fail(table.where + ": the first column must be 'wavelength_nm'");
    table.columns.assign(csv.columns.begin() + 1, csv.columns.end());
    std::map<double, std::vector<double>> rows;
    for (const std::vector<std::string>& fields : csv.rows) {
        std::vector<double>& row = rows[as_number(fields[0], table.where)];
        for (std::size_t i = 1; i < fields.size(); ++i)
            row.push_back(as_number(fields[i], table.where + ", " + shown_text(fields[0]) + " nm, '" +
                                                   shown_text(csv.columns[i]) + "'"));
    }
    return from_rows(std::move(table), rows);
}

Spectrum resampled(const SpectraTable& table, std::size_t column)
{
    Spectrum result{};
    const std::vector<double>&at = table.wavelengths_nm, &values = table.values[column];
    for (int i = 0; i < kPackWavelengths; ++i) {
        const double wavelength = double(kFirstWavelength_nm) + i * double(kWavelengthStep_nm);
        const auto above = std::lower_bound(at.begin(), at.end(), wavelength);
        if (above == at.end() || (above == at.begin() && *above > wavelength))
            continue;
        const std::size_t high = std::size_t(above - at.begin()), low = *above == wavelength ? high : high - 1;
        const double part = high == low ? 0 : (wavelength - at[low]) / (at[high] - at[low]);
        result[i] = values[low] + part * (values[high] - values[low]);
    }
    return result;
}

namespace {

// The fourth principal component of the 190 measured reflectances has half the variance of the third: each step brings
// the three closer by that factor, 200 by more than double precision can show.
constexpr int kIterations = 200;

double dot(const Spectrum& a, const Spectrum& b)
{
    double sum = 0;
    for (int i = 0; i < kPackWavelengths; ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Gram–Schmidt; false if the three are not independent.
bool orthonormalize(std::array<Spectrum, 3>& vectors)
{
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < k; ++j) {
            const double shared = dot(vectors[k], vectors[j]);
            for (int i = 0; i < kPackWavelengths; ++i)
                vectors[k][i] -= shared * vectors[j][i];
        }
        const double norm = std::sqrt(dot(vectors[k], vectors[k]));
        if (!(norm > 1e-12))
            return false;
        for (double& value : vectors[k])
            value /= norm;
    }
    return true;
}

/// Spans the space of the first three principal components: orthogonal iteration. Only the span matters.
std::array<Spectrum, 3> principal_components(const std::vector<Spectrum>& measured)
{
    std::array<Spectrum, 3> vectors{};
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < kPackWavelengths; ++i)
            vectors[k][i] = std::cos(k * i * M_PI / kPackWavelengths);
    bool independent = orthonormalize(vectors);
    for (int iteration = 0; iteration < kIterations && independent; ++iteration) {
        std::array<Spectrum, 3> next{};
        for (const Spectrum& reflectance : measured)
            for (std::size_t k = 0; k < 3; ++k) {
                const double weight = dot(reflectance, vectors[k]);
                for (int i = 0; i < kPackWavelengths; ++i)
                    next[k][i] += weight * reflectance[i];
            }
        vectors = next;
        independent = orthonormalize(vectors);
    }
    if (!independent)
        fail("the measured reflectances have fewer than three independent spectra");
    return vectors;
}

} // namespace

std::array<Spectrum, 3> reflectance_basis(const std::vector<Spectrum>& measured,
                                          const std::array<Spectrum, 3>& observer, const Spectrum& d65)
{
    const std::array<Spectrum, 3> components = principal_components(measured);
    const double white = dot(observer[1], d65);
    Matrix3 seen; // XYZ of each component
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k) {
            double sum = 0;
            for (int i = 0; i < kPackWavelengths; ++i)
                sum += observer[row][i] * d65[i] * components[k][i];
            seen[row * 3 + k] = float(sum / white);
        }
    const Matrix3 mix = product(inverse(seen), kSrgbToXyz);
    std::array<Spectrum, 3> basis{};
    for (int color = 0; color < 3; ++color)
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < kPackWavelengths; ++i)
                basis[color][i] += double(mix[k * 3 + color]) * components[k][i];
    return basis;
}

} // namespace srisp::tool
