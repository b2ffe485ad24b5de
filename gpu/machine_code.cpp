#include "gpu/machine_code.h"

#include "base/error.h"
#include "gpu/marks.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <string_view>

namespace shadowbench::gpu {
namespace {

/// An instruction's name and operands; the first operand is what most write.
struct Instruction {
    std::string name, text;
    std::vector<std::string> operands;
};

Instruction instructionOf(const std::string& line) {
    Instruction read;
    std::string text = line.substr(0, line.find(';'));
    std::istringstream words(text);
    words >> read.name;
    std::getline(words, read.text);
    std::string operand;
    int depth = 0;
    for (const char c : read.text + ",") {
        if (c == '[') ++depth;
        if (c == ']') --depth;
        if (c == ',' && depth == 0) {
            const std::size_t begin = operand.find_first_not_of(" \t"), end = operand.find_last_not_of(" \t");
            if (begin != std::string::npos) read.operands.push_back(operand.substr(begin, end - begin + 1));
            operand.clear();
        } else {
            operand += c;
        }
    }
    return read;
}

bool starts(const Instruction& instruction, std::initializer_list<std::string_view> prefixes) {
    return std::ranges::any_of(prefixes, [&](std::string_view prefix) { return instruction.name.starts_with(prefix); });
}

/// The registers that a text names: "v3" for v3, v3 and v4 for v[3:4].
std::vector<std::string> registersOf(const std::string& text) {
    std::vector<std::string> found;
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = 0; at < text.size(); ++at) {
        if ((at > 0 && isWord(text[at - 1])) || (text[at] != 'v' && text[at] != 's')) continue;
        unsigned first = 0, last = 0;
        if (std::sscanf(text.c_str() + at + 1, "[%u:%u]", &first, &last) == 2)
            for (unsigned i = first; i <= std::min(last, first + 31); ++i) found.push_back(fmt::format("{}{}", text[at], i));
        else if (std::sscanf(text.c_str() + at + 1, "%u", &first) == 1)
            found.push_back(fmt::format("{}{}", text[at], first));
        else if (text.compare(at, 3, "vcc") == 0)
            found.emplace_back("vcc");
    }
    return found;
}

/// What Mesa's own estimate (ACO, get_perf_info) takes for the kinds of instructions of RDNA in waves of 64, which a SIMD of
/// 32 lanes does in two steps. On GCN 5 vector instructions take twice as long, each in the same ratio to the others.
struct Timing {
    double latency = 2; // until the result can be used
    double vector = 0, complex = 0, scalar = 0;
};

Timing timingOf(const Instruction& i) {
    if (!i.name.starts_with("v_")) return {2, 0, 0, 1};
    if (i.name.find("_f64") != std::string::npos) return {22, 32, 32, 0};
    if (starts(i, {"v_exp_", "v_log_", "v_rcp_", "v_rsq_", "v_sqrt_", "v_sin_", "v_cos_"})) return {10, 2, 8, 0};
    if (starts(i, {"v_mul_lo_u32", "v_mul_lo_i32", "v_mul_hi_", "v_mad_u64", "v_mad_i64"})) return {8, 8, 8, 0};
    return {5, 2, 0, 0};
}

/// Cycles until memory answers, of the same source.
constexpr double textureLatency = 320, farScalarLatency = 200, nearScalarLatency = 30, sharedLatency = 20;

/// Runs blocks one after another in the order of addresses, which is how often memory is waited for.
class Timer {
public:
    /// What a block adds by this instruction.
    void add(const Instruction& i, Busy& busy) {
        const double before = now_;
        if (i.name == "s_waitcnt")
            wait(i.text);
        else if (starts(i, {"image_", "buffer_", "global_", "flat_", "scratch_"}))
            vectorMemory(i, busy);
        else if (starts(i, {"s_load", "s_buffer_load"}))
            scalarMemory(i, busy);
        else if (starts(i, {"ds_"}))
            sharedMemory(i);
        else if (!starts(i, {"s_nop", "s_clause", "s_inst_prefetch", "s_endpgm", "s_code_end", "s_waitcnt"}))
            compute(i, busy);
        busy[Part::Latency] += now_ - before;
    }

private:
    void waitFor(const std::string& operands) {
        for (const std::string& name : registersOf(operands))
            if (const auto found = ready_.find(name); found != ready_.end()) now_ = std::max(now_, found->second);
    }

    void compute(const Instruction& i, Busy& busy) {
        const Timing timing = timingOf(i);
        waitFor(i.text);
        if (timing.complex > 0) now_ = std::max(now_, complexFree_);
        const double start = now_;
        now_ += std::max(timing.vector > 0 ? 2.0 : 1.0, timing.complex == timing.vector ? timing.vector : 0.0);
        if (timing.complex > 0) complexFree_ = start + timing.complex;
        if (!i.operands.empty())
            for (const std::string& name : registersOf(i.operands.front())) ready_[name] = start + timing.latency;
        busy[Part::Vector] += timing.vector;
        busy[Part::Complex] += timing.complex;
        busy[Part::Scalar] += timing.scalar;
    }

    void vectorMemory(const Instruction& i, Busy& busy) {
        waitFor(i.text);
        ++now_;
        const bool isStore = i.name.find("_store") != std::string::npos || i.name.find("_atomic") != std::string::npos;
        if (isStore)
            ++busy[Part::Stores];
        else
            ++busy[i.name.starts_with("image_") ? Part::TextureReads : Part::BufferReads];
        if (!isStore || i.name.find("_atomic") != std::string::npos) vector_.push_back(now_ + textureLatency);
    }

    void scalarMemory(const Instruction& i, Busy& busy) {
        waitFor(i.text);
        ++now_;
        ++busy[Part::Scalar];
        const bool isConstant = i.operands.size() > 2 && (i.operands[2] == "null" || i.operands[2].starts_with("0x"));
        scalar_.push_back(now_ + (isConstant || i.name.starts_with("s_load") ? nearScalarLatency : farScalarLatency));
    }

    void sharedMemory(const Instruction& i) {
        waitFor(i.text);
        ++now_;
        scalar_.push_back(now_ + sharedLatency);
    }

    /// "vmcnt(2) lgkmcnt(0)": until that many at most are on their way.
    void wait(const std::string& text) {
        const auto left = [&](const char* counter) {
            const std::size_t at = text.find(counter);
            return at == std::string::npos ? std::string::npos
                                           : std::stoul(text.substr(at + std::string_view(counter).size()));
        };
        for (std::size_t many = left("vmcnt("); vector_.size() > many; vector_.pop_front())
            now_ = std::max(now_, vector_.front());
        for (std::size_t many = left("lgkmcnt("); scalar_.size() > many; scalar_.pop_front())
            now_ = std::max(now_, scalar_.front());
        now_ += 1;
    }

    double now_ = 0, complexFree_ = 0;
    std::map<std::string, double> ready_;
    std::deque<double> vector_, scalar_; // when what is on its way arrives
};

/// Which registers hold the word of a mark.
class MarkWords {
public:
    /// The mark that the instruction stores.
    std::optional<unsigned> storedBy(const Instruction& i) {
        if (starts(i, {"buffer_store_dword", "buffer_store_b32"}) && !i.operands.empty()) {
            const auto found = words_.find(i.operands.front());
            return found == words_.end() ? std::nullopt : std::optional(found->second);
        }
        if (i.name.find("_store") != std::string::npos || i.operands.empty()) return std::nullopt;
        const std::optional<unsigned> moved = movedBy(i);
        for (const std::string& name : registersOf(i.operands.front())) words_.erase(name);
        if (moved) words_[i.operands.front()] = *moved;
        return std::nullopt;
    }

private:
    [[nodiscard]] std::optional<unsigned> movedBy(const Instruction& i) const {
        if (!starts(i, {"v_mov_b32", "s_mov_b32"}) || i.operands.size() < 2) return std::nullopt;
        const std::string& from = i.operands[1];
        if (const auto found = words_.find(from); found != words_.end()) return found->second;
        if (!from.starts_with("0x")) return std::nullopt;
        const unsigned long word = std::stoul(from, nullptr, 16);
        if (word < firstPlace || word >= firstPlace + mostMarks) return std::nullopt;
        return static_cast<unsigned>(word - firstPlace);
    }

    std::map<std::string, unsigned> words_;
};

Jump jumpOf(const Instruction& i) {
    if (i.name == "s_branch" || i.name == "s_endpgm" || i.name == "s_setpc_b64") return Jump::Always;
    if (!i.name.starts_with("s_cbranch_")) return Jump::None;
    return i.name.starts_with("s_cbranch_exec") ? Jump::Divergent : Jump::Uniform;
}

struct Parsed {
    std::vector<std::vector<Instruction>> blocks; // of which labels and jumps are the ends
    std::map<std::string, std::size_t> labels;
};

Parsed parsed(const std::string& assembly) {
    Parsed code;
    std::istringstream lines(assembly);
    code.blocks.emplace_back();
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("BB")) {
            if (!code.blocks.back().empty()) code.blocks.emplace_back();
            code.labels[line.substr(0, line.find(':'))] = code.blocks.size() - 1;
        } else if (line.starts_with("\t")) {
            const Instruction instruction = instructionOf(line);
            if (instruction.name.empty()) continue;
            code.blocks.back().push_back(instruction);
            if (jumpOf(instruction) != Jump::None) code.blocks.emplace_back();
        }
    }
    return code;
}

} // namespace

void Busy::add(const Busy& other, double times) {
    for (std::size_t i = 0; i < partCount; ++i) parts.at(i) += times * other.parts.at(i);
}

std::vector<CodeBlock> codeBlocks(const std::string& assembly) {
    const Parsed code = parsed(assembly);
    std::vector<CodeBlock> blocks;
    Timer timer;
    MarkWords words;
    for (const std::vector<Instruction>& instructions : code.blocks) {
        CodeBlock& block = blocks.emplace_back();
        for (const Instruction& i : instructions) {
            if (const auto mark = words.storedBy(i)) {
                block.marks.push_back(*mark);
                continue;
            }
            timer.add(i, block.busy);
            block.jump = jumpOf(i);
            if (!i.name.starts_with("s_branch") && !i.name.starts_with("s_cbranch")) continue;
            const auto target = i.operands.empty() ? code.labels.end() : code.labels.find(i.operands.front());
            if (target == code.labels.end())
                throw BadInput("machine code jumps to \"" + i.text +
                               "\", which it does not have; is Mesa of another version?");
            block.target = target->second;
        }
    }
    return blocks;
}

} // namespace shadowbench::gpu
