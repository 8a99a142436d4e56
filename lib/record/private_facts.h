// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenImageIO/imageio.h>

// The one rule of what a result must not pass on of the image that it was made from (docs/privacy.md).

namespace srisp {

/// Erases where a picture was taken, which camera, lens or machine took it, whose these are, who is shown, what
/// identifies the file, and pictures that lie beside it. Of what tells its making, folders of the maker's machine.
void erase_private_facts(OIIO::ImageSpec& spec);

/// Whether an attribute of this name is one that erase_private_facts erases.
bool is_private_fact(const std::string& name);

/// A text with the last name of each absolute path in it instead of the path: "-i /home/me/a.jpg" becomes "-i a.jpg".
/// Relative paths stay as they are.
std::string without_folders(const std::string& text);

} // namespace srisp
