// SPDX-License-Identifier: Apache-2.0
#include "train/learning/process_group.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <exception>

#ifdef SRISP_HAS_GLOO
#ifndef USE_C10D_GLOO // LibTorch's own flags have it in some builds
#define USE_C10D_GLOO
#endif
#include <torch/csrc/distributed/c10d/PrefixStore.hpp>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>
#endif

namespace srisp::train {

#ifdef SRISP_HAS_GLOO

namespace {

/// This machine's own address towards `host`. What its own name resolves to, which Gloo would take, is on many machines
/// a loopback address that the others cannot reach.
Expected<std::string> own_address_towards(const std::string& host, const std::string& port)
{
    addrinfo hints{}, *list = nullptr;
    hints.ai_socktype = SOCK_DGRAM;
    if (const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &list); code != 0)
        return Error{ "cannot find the machine '" + host + "': " + gai_strerror(code) };
    std::string address;
    for (const addrinfo* entry = list; entry && address.empty(); entry = entry->ai_next) {
        // Connecting a datagram socket sends nothing; it only chooses the route.
        const int route = socket(entry->ai_family, SOCK_DGRAM, 0);
        sockaddr_storage own{};
        socklen_t size = sizeof own;
        char text[NI_MAXHOST];
        if (route >= 0 && connect(route, entry->ai_addr, entry->ai_addrlen) == 0 &&
            getsockname(route, reinterpret_cast<sockaddr*>(&own), &size) == 0 &&
            getnameinfo(reinterpret_cast<sockaddr*>(&own), size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0)
            address = text;
        if (route >= 0)
            close(route);
    }
    freeaddrinfo(list);
    if (address.empty())
        return Error{ "no way from this machine to '" + host + "'" };
    return address;
}

/// Gloo's and the store's messages, without the stack traces behind them.
std::string first_line(const std::exception& error)
{
    const std::string text = error.what();
    return text.substr(0, text.find('\n'));
}

} // namespace

bool ProcessGroup::several_possible()
{
    return true;
}

struct ProcessGroup::Backend {
    c10::intrusive_ptr<c10d::TCPStore> store;
    c10::intrusive_ptr<c10d::ProcessGroupGloo> gloo;

    /// Waits until all have come. LibTorch's exceptions say why they have not.
    Status meet(const Membership& membership)
    {
        const std::chrono::seconds timeout(membership.timeout_s);
        const std::size_t colon = membership.address.rfind(':');
        const std::string host = membership.address.substr(0, colon), port = membership.address.substr(colon + 1);
        c10d::TCPStoreOptions options;
        options.port = static_cast<std::uint16_t>(std::stoi(port));
        options.isServer = membership.rank == 0;
        options.numWorkers = static_cast<std::size_t>(membership.size);
        options.timeout = timeout;
        store = c10::make_intrusive<c10d::TCPStore>(host, options);
        const Expected<std::string> own_address = own_address_towards(host, port);
        if (!own_address)
            return own_address.error();
        auto gloo_options = c10d::ProcessGroupGloo::Options::create(timeout);
        gloo_options->threads = 1;
        gloo_options->devices = { c10d::ProcessGroupGloo::createDeviceForHostname(*own_address) };
        gloo = c10::make_intrusive<c10d::ProcessGroupGloo>(store, membership.rank, membership.size, gloo_options);
        return {};
    }
};

Expected<std::unique_ptr<ProcessGroup>> ProcessGroup::join(const Membership& membership)
{
    auto group = std::make_unique<ProcessGroup>();
    group->m_membership = membership;
    if (membership.size == 1)
        return group;
    group->m_backend = std::make_unique<Backend>();
    Status status;
    try {
        status = group->m_backend->meet(membership);
    } catch (const std::exception& error) {
        status = Error{ first_line(error) };
    }
    if (!status)
        return Error{ "rank " + std::to_string(membership.rank) + " of " + std::to_string(membership.size) +
                      " could not meet the others at " + membership.address + " within " +
                      std::to_string(membership.timeout_s) + " s: " + status.error().message };
    return group;
}

/// Runs a collective call on a copy in the CPU's memory, where Gloo works, and puts the result back.
template<class Call> static Status collective(const Membership& membership, torch::Tensor tensor, const Call& call)
{
    const torch::NoGradGuard no_gradient;
    std::vector<at::Tensor> tensors = { tensor.detach().cpu().contiguous() };
    try {
        call(tensors)->wait();
    } catch (const std::exception& error) {
        return Error{ "rank " + std::to_string(membership.rank) +
                      " has lost another process (it ended, or did not answer within " +
                      std::to_string(membership.timeout_s) + " s): " + first_line(error) };
    }
    if (!tensors[0].is_alias_of(tensor))
        tensor.copy_(tensors[0]);
    return {};
}

Status ProcessGroup::sum(torch::Tensor tensor)
{
    if (!m_backend)
        return {};
    return collective(m_membership, tensor, [this](auto& tensors) { return m_backend->gloo->allreduce(tensors); });
}

Status ProcessGroup::broadcast(torch::Tensor tensor)
{
    if (!m_backend)
        return {};
    return collective(m_membership, tensor, [this](auto& tensors) { return m_backend->gloo->broadcast(tensors); });
}

#else

bool ProcessGroup::several_possible()
{
    return false;
}

struct ProcessGroup::Backend {};

Expected<std::unique_ptr<ProcessGroup>> ProcessGroup::join(const Membership& membership)
{
    if (membership.size > 1)
        return Error{ "this program was built without Gloo's headers (libgloo-dev): one process only" };
    auto group = std::make_unique<ProcessGroup>();
    group->m_membership = membership;
    return group;
}

Status ProcessGroup::sum(torch::Tensor)
{
    return {};
}

Status ProcessGroup::broadcast(torch::Tensor)
{
    return {};
}

#endif

ProcessGroup::ProcessGroup() = default;

ProcessGroup::~ProcessGroup() = default;

Status ProcessGroup::rank_0_alone(const std::function<void(const StillThere& still_there)>& work)
{
    using Clock = std::chrono::steady_clock;
    torch::Tensor at_work = torch::ones({ 1 });
    if (!writes()) {
        while (at_work.item<float>() > 0)
            if (Status status = broadcast(at_work); !status)
                return status;
        return {};
    }
    Clock::time_point last = Clock::now();
    Status status;
    work([&] {
        if (!status || Clock::now() - last < std::chrono::seconds(1))
            return status;
        status = broadcast(at_work);
        last = Clock::now();
        return status;
    });
    at_work.zero_();
    return status ? broadcast(at_work) : status;
}

Status ProcessGroup::check_same(const std::string& text, const std::string& what)
{
    // Bytes as floats: exact, and one kind of message is enough.
    torch::Tensor own = torch::empty({ static_cast<std::int64_t>(text.size()) });
    for (std::size_t i = 0; i < text.size(); ++i)
        own[static_cast<std::int64_t>(i)] = static_cast<float>(static_cast<unsigned char>(text[i]));
    torch::Tensor length = torch::full({ 1 }, static_cast<double>(text.size()));
    if (Status status = broadcast(length); !status)
        return status;
    bool differs = length.item<double>() != static_cast<double>(text.size());
    torch::Tensor first = torch::zeros({ static_cast<std::int64_t>(length.item<double>()) });
    if (writes())
        first = own;
    if (Status status = broadcast(first); !status)
        return status;
    differs = differs || !torch::equal(first, own);
    torch::Tensor differing = torch::full({ 1 }, differs ? 1.0 : 0.0);
    if (Status status = sum(differing); !status)
        return status;
    if (differing.item<double>() > 0)
        return Error{ "the processes do not have the same " + what };
    return {};
}

} // namespace srisp::train
