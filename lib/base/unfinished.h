// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <srisp/expected.h>

// What is being written lies beside the place that it is to take, as `.NAME.partial-0123456789abcdef.EXT`, and is
// locked while the program that writes it lives. Half of the digits are random, the other half a hash of these and of
// the target's name: what has such a name is none of a user's.

namespace srisp {

/// A new such name, in the target's folder.
std::filesystem::path unfinished_name(const std::filesystem::path& target);

/// Whether a name (without its folder) is one that unfinished_name could have made.
bool is_unfinished_name(const std::string& name, const std::filesystem::path& target);

/// A new file or folder under such a name, open and locked. The lock is released when the descriptor and its copies
/// are closed.
struct Unfinished {
    std::string path;
    int descriptor;
};

/// Makes one that was not there before; no link is followed. Errors: the disk's own, in its words.
Expected<Unfinished> make_unfinished_file(const std::filesystem::path& target);
/// The same for its owner only.
Expected<Unfinished> make_private_unfinished_file(const std::filesystem::path& target);
/// A folder for its owner only.
Expected<Unfinished> make_unfinished_folder(const std::filesystem::path& target);

/// Calls `remove` for all of a target that programs left which live no more, and whose owner this one's user is.
void for_each_leftover(const std::filesystem::path& target,
                       const std::function<void(const std::filesystem::path&)>& remove);

/// Removes all files of this kind in the target's folder, of whatever target, that programs left which live no more.
/// Only the first time that a process asks for a folder: one with many files is not looked through for each of them.
void remove_leftover_files(const std::filesystem::path& target);

/// Opens what no other has locked, and locks it; -1: it is locked, a link, another's, or gone. Of `kind` only: S_IFREG
/// or S_IFDIR.
int lock_leftover(const std::filesystem::path& path, unsigned kind);

} // namespace srisp
