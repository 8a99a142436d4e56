// SPDX-License-Identifier: Apache-2.0
#include <srisp/ocio_transform.h>

#include "clf_text.h"
#include "ocio_group.h"
#include "pipeline_operators.h"

namespace srisp {

namespace OCIO = OCIO_NAMESPACE;

Expected<OCIO::GroupTransformRcPtr> make_ocio_transform(const Model& model, const Parameters& parameters,
                                                        Direction direction, int lut_size)
{
    try {
        const auto operators = pipeline_operators(model, parameters, direction, lut_size);
        if (!operators)
            return operators.error();
        return ocio_group(*operators);
    } catch (const std::exception& error) {
        return Error{ std::string("OpenColorIO transform: ") + error.what() };
    }
}

Expected<std::string> make_clf(const Model& model, const Parameters& parameters, Direction direction,
                               const ClfLabel& label, int lut_size)
{
    try {
        const auto operators = pipeline_operators(model, parameters, direction, lut_size);
        if (!operators)
            return operators.error();
        return clf_text(*operators, label);
    } catch (const std::exception& error) {
        return Error{ std::string("CLF: ") + error.what() };
    }
}

} // namespace srisp
