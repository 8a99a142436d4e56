// SPDX-License-Identifier: Apache-2.0
#include "task_message.h"

#include <cstdlib>

namespace srisp::tool {

namespace {

constexpr std::size_t kTexts = 12;

std::uint64_t number(const std::string& text)
{
    return std::strtoull(text.c_str(), nullptr, 10);
}

} // namespace

Message task_message(const WorkerTask& made)
{
    const BatchTask& task = made.task;
    const ListedFile shot = task.shot.value_or(ListedFile());
    return { task.photo.path,
             task.photo.name,
             std::to_string(task.copy),
             task.reference,
             std::to_string(task.seed),
             task.output,
             shot.path,
             shot.name,
             std::to_string(task.shot_seed),
             made.path,
             made.reference,
             made.settings + (made.may_replace ? "+" : "-") };
}

std::optional<WorkerTask> task_of_message(const Message& message)
{
    if (message.size() != kTexts || message.back().empty())
        return {};
    WorkerTask made;
    BatchTask& task = made.task;
    task.photo = { message[0], message[1] };
    task.copy = int(number(message[2]));
    task.reference = message[3];
    task.seed = number(message[4]);
    task.output = message[5];
    if (!message[6].empty())
        task.shot = ListedFile{ message[6], message[7] };
    task.shot_seed = number(message[8]);
    made.path = message[9];
    made.reference = message[10];
    made.settings = message[11].substr(0, message[11].size() - 1);
    made.may_replace = message[11].back() == '+';
    return made;
}

} // namespace srisp::tool
