// SPDX-License-Identifier: Apache-2.0
// Runs a command, looks at each system call by which it or what it starts would change files in a folder, and has one
// of them fail. Calls are counted over all processes and threads, also those of the C library's own streams, which no
// preloaded library sees. Linux on x86-64.
//
//     fault_tracer FOLDER LOG AT ACTION COMMAND…
//
// LOG gets a line for each call, `number name path`. Call number AT (0: none) meets ACTION:
//   ENOSPC      that call, and all later ones that take space, fail: the disk is full
//   EROFS       that call and all later ones fail: the folder has become read-only
//   EIO, EINTR  it fails
//   short       it writes only a part
//   kill        the command is killed before the call; what it started goes on
//   killall     so is all that it started
//   run LINE    a shell runs LINE before the call
// The exit code is the command's, or 128 and the number of the signal that ended it.
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

/// Where a call says what it changes, and what it needs.
enum class Target { descriptor, path, path_at, new_path, new_path_at, open, open_at };
struct Call {
    const char* name;
    Target target;
    bool takes_space;
};

const std::map<long, Call>& calls()
{
    static const std::map<long, Call> all{
        { SYS_write, { "write", Target::descriptor, true } },
        { SYS_pwrite64, { "pwrite", Target::descriptor, true } },
        { SYS_writev, { "writev", Target::descriptor, true } },
        { SYS_pwritev, { "pwritev", Target::descriptor, true } },
        { SYS_pwritev2, { "pwritev", Target::descriptor, true } },
        { SYS_sendfile, { "sendfile", Target::descriptor, true } },
        { SYS_ftruncate, { "ftruncate", Target::descriptor, true } },
        { SYS_fallocate, { "fallocate", Target::descriptor, true } },
        { SYS_fsync, { "fsync", Target::descriptor, false } },
        { SYS_fdatasync, { "fsync", Target::descriptor, false } },
        { SYS_fchmod, { "chmod", Target::descriptor, false } },
        { SYS_close, { "close", Target::descriptor, false } },
        { SYS_truncate, { "truncate", Target::path, true } },
        { SYS_mkdir, { "mkdir", Target::path, true } },
        { SYS_mkdirat, { "mkdir", Target::path_at, true } },
        { SYS_unlink, { "unlink", Target::path, false } },
        { SYS_rmdir, { "unlink", Target::path, false } },
        { SYS_unlinkat, { "unlink", Target::path_at, false } },
        { SYS_chmod, { "chmod", Target::path, false } },
        { SYS_rename, { "rename", Target::new_path, false } },
        { SYS_renameat, { "rename", Target::new_path_at, false } },
        { SYS_renameat2, { "rename", Target::new_path_at, false } },
        { SYS_link, { "link", Target::new_path, true } },
        { SYS_linkat, { "link", Target::new_path_at, true } },
        { SYS_symlink, { "symlink", Target::new_path, true } },
        { SYS_creat, { "open", Target::path, true } },
        { SYS_open, { "open", Target::open, true } },
        { SYS_openat, { "open", Target::open_at, true } },
    };
    return all;
}

struct Options {
    std::string folder, action;
    long at;
    std::FILE* log;
};

[[noreturn]] void give_up(const char* what)
{
    std::fprintf(stderr, "fault_tracer: %s: %s\n", what, std::strerror(errno));
    std::exit(125);
}

/// What a link in /proc leads to; "": to nothing.
std::string link_in(pid_t task, const std::string& name)
{
    char path[PATH_MAX];
    const ssize_t length = readlink(("/proc/" + std::to_string(task) + "/" + name).c_str(), path, sizeof path);
    return { path, std::size_t(length > 0 ? length : 0) };
}

std::string text_at(pid_t task, unsigned long address)
{
    std::string text;
    for (char c = 1; text.size() < PATH_MAX; ++address) {
        iovec here{ &c, 1 }, there{ reinterpret_cast<void*>(address), 1 };
        if (process_vm_readv(task, &here, 1, &there, 1, 0) != 1 || c == 0)
            break;
        text += c;
    }
    return text;
}

std::string absolute(pid_t task, int folder, const std::string& path)
{
    if (!path.empty() && path[0] == '/')
        return path;
    return link_in(task, folder == AT_FDCWD ? "cwd" : "fd/" + std::to_string(folder)) + "/" + path;
}

bool opened_for_writing(pid_t task, int descriptor)
{
    const std::string path = "/proc/" + std::to_string(task) + "/fdinfo/" + std::to_string(descriptor);
    std::FILE* const file = std::fopen(path.c_str(), "r");
    unsigned flags = 0;
    if (!file || std::fscanf(file, "pos: %*s flags: %o", &flags) != 1)
        flags = O_RDONLY;
    if (file)
        std::fclose(file);
    return (flags & O_ACCMODE) != O_RDONLY;
}

/// What a call would change; "": nothing.
std::string target_of(pid_t task, const Call& call, const user_regs_struct& registers)
{
    const auto path = [&](int folder, unsigned long address) { return absolute(task, folder, text_at(task, address)); };
    const auto changes = [](unsigned long flags) { return (flags & (O_ACCMODE | O_CREAT | O_TRUNC)) != 0; };
    switch (call.target) {
    case Target::descriptor: {
        const int file = int(registers.rdi);
        const std::string name = link_in(task, "fd/" + std::to_string(file));
        return std::strcmp(call.name, "close") != 0 || opened_for_writing(task, file) ? name : "";
    }
    case Target::path:
        return path(AT_FDCWD, registers.rdi);
    case Target::path_at:
        return path(int(registers.rdi), registers.rsi);
    case Target::new_path:
        return path(AT_FDCWD, registers.rsi);
    case Target::new_path_at:
        return path(int(registers.rdx), registers.r10);
    case Target::open:
        return changes(registers.rsi) ? path(AT_FDCWD, registers.rdi) : "";
    case Target::open_at:
        return changes(registers.rdx) ? path(int(registers.rdi), registers.rsi) : "";
    }
    return "";
}

class Tracer {
public:
    explicit Tracer(const Options& options) : m_options(options) {}

    int run(pid_t command);

private:
    void look_at(pid_t task);
    bool fails_now(const Call& call) const
    {
        return m_lasting == ENOSPC ? call.takes_space : m_lasting == EROFS && std::strcmp(call.name, "close") != 0;
    }
    bool meet(pid_t task, const Call& call, user_regs_struct& registers);
    void skip(pid_t task, user_regs_struct& registers, int error);

    const Options& m_options;
    pid_t m_command = 0;
    long m_count = 0;
    int m_lasting = 0; ///< the error of later calls: ENOSPC, EROFS
    std::set<pid_t> m_tasks;
    std::map<pid_t, int> m_failing; ///< their call is done, and shall say that it failed
};

void Tracer::skip(pid_t task, user_regs_struct& registers, int error)
{
    registers.orig_rax = static_cast<unsigned long long>(-1);
    registers.rax = static_cast<unsigned long long>(-error);
    ptrace(PTRACE_SETREGS, task, nullptr, &registers);
}

/// Whether the task is to stop when the call is done.
bool Tracer::meet(pid_t task, const Call& call, user_regs_struct& registers)
{
    const std::string& action = m_options.action;
    if (action == "kill" || action == "killall") {
        for (const pid_t each : action == "kill" ? std::set<pid_t>{ m_command } : m_tasks)
            ::kill(each, SIGKILL);
    } else if (action.rfind("run ", 0) == 0) {
        if (std::system(action.substr(4).c_str()) != 0)
            give_up(action.c_str());
    } else if (action == "short") {
        if (registers.rdx > 1)
            registers.rdx = std::strcmp(call.name, "writev") == 0 ? 1 : registers.rdx / 2;
        ptrace(PTRACE_SETREGS, task, nullptr, &registers);
    } else {
        const std::map<std::string, int> errors{
            { "ENOSPC", ENOSPC }, { "EROFS", EROFS }, { "EIO", EIO }, { "EINTR", EINTR }
        };
        const int error = errors.at(action);
        m_lasting = error == ENOSPC || error == EROFS ? error : 0;
        if (std::strcmp(call.name, "close") == 0) { // one that fails closes, too
            m_failing[task] = error;
            return true;
        }
        skip(task, registers, error);
    }
    return false;
}

void Tracer::look_at(pid_t task)
{
    user_regs_struct registers;
    if (ptrace(PTRACE_GETREGS, task, nullptr, &registers) != 0)
        return;
    const auto call = calls().find(long(registers.orig_rax));
    const std::string target = call == calls().end() ? "" : target_of(task, call->second, registers);
    bool stop = false;
    if (target.compare(0, m_options.folder.size(), m_options.folder) == 0) {
        std::fprintf(m_options.log, "%ld %s %s\n", ++m_count, call->second.name, target.c_str());
        std::fflush(m_options.log);
        if (m_count == m_options.at)
            stop = meet(task, call->second, registers);
        else if (fails_now(call->second))
            skip(task, registers, m_lasting);
    }
    ptrace(stop ? PTRACE_SYSCALL : PTRACE_CONT, task, nullptr, nullptr);
}

int Tracer::run(pid_t command)
{
    m_command = command;
    m_tasks.insert(command);
    int code = 0, status = 0;
    for (pid_t task; (task = waitpid(-1, &status, __WALL)) > 0 || errno == EINTR;) {
        if (task <= 0)
            continue;
        if (WIFEXITED(status) || WIFSIGNALED(status)) {
            m_tasks.erase(task);
            if (task == command)
                code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            continue;
        }
        m_tasks.insert(task);
        const int event = status >> 16, signal = WSTOPSIG(status);
        if (event == PTRACE_EVENT_SECCOMP) {
            look_at(task);
        } else if (signal == (SIGTRAP | 0x80)) {
            user_regs_struct registers;
            if (const auto failing = m_failing.find(task); failing != m_failing.end()) {
                if (ptrace(PTRACE_GETREGS, task, nullptr, &registers) == 0) {
                    registers.rax = static_cast<unsigned long long>(-failing->second);
                    ptrace(PTRACE_SETREGS, task, nullptr, &registers);
                }
                m_failing.erase(failing);
            }
            ptrace(PTRACE_CONT, task, nullptr, nullptr);
        } else if (event == PTRACE_EVENT_STOP && signal != SIGTRAP) {
            ptrace(PTRACE_LISTEN, task, nullptr, nullptr); // stopped as by Ctrl-Z
        } else {
            ptrace(PTRACE_CONT, task, nullptr, reinterpret_cast<void*>(event ? 0l : long(signal)));
        }
    }
    return code;
}

/// Has the kernel stop this process at the calls that matter, and at no others.
void filter_calls()
{
    std::vector<sock_filter> program{ BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)) };
    for (const auto& [number, call] : calls()) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, unsigned(number), 0, 1));
        program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRACE));
    }
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog filter{ static_cast<unsigned short>(program.size()), program.data() };
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0)
        give_up("seccomp");
}

} // namespace

int main(int count, char** words)
{
    if (count < 6) {
        std::fprintf(stderr, "fault_tracer FOLDER LOG AT ACTION COMMAND…\n");
        return 2;
    }
    Options options{ words[1], words[4], std::atol(words[3]), std::fopen(words[2], "we") };
    if (!options.log)
        give_up(words[2]);
    const pid_t command = fork();
    if (command == 0) {
        raise(SIGSTOP);
        filter_calls();
        execvp(words[5], words + 5);
        give_up(words[5]);
    }
    int status = 0;
    if (command < 0 || waitpid(command, &status, WUNTRACED) != command)
        give_up("fork");
    const long follow = PTRACE_O_TRACESECCOMP | PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK |
                        PTRACE_O_TRACECLONE | PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL;
    if (ptrace(PTRACE_SEIZE, command, nullptr, reinterpret_cast<void*>(follow)) != 0) {
        ::kill(command, SIGKILL);
        give_up("ptrace");
    }
    ::kill(command, SIGCONT);
    return Tracer(options).run(command);
}
