#include "render/vulkan/dead_code.h"

#include <map>
#include <set>
#include <span>
#include <utility>

#define SPV_ENABLE_UTILITY_CODE
#include <glslang/SPIRV/spirv.hpp>

namespace malus::vulkan {
namespace {

using Words = std::vector<std::uint32_t>;
using Instruction = std::span<const std::uint32_t>;
using Id = std::uint32_t;

constexpr std::size_t kHeaderWords = 5;

spv::Op opcode(Instruction i) { return static_cast<spv::Op>(i[0] & spv::OpCodeMask); }

// Result of an instruction; 0: none.
Id resultId(Instruction i) {
  bool hasResult = false, hasType = false;
  spv::HasResultAndType(opcode(i), &hasResult, &hasType);
  return hasResult ? i[hasType ? 2 : 1] : 0;
}

void append(Words& out, Instruction i) { out.insert(out.end(), i.begin(), i.end()); }

// A function whose branches on constants are replaced and whose unreachable blocks are removed.
class PrunedFunction {
 public:
  PrunedFunction(std::span<const Instruction> instructions, std::map<Id, bool> constants)
      : constants_(std::move(constants)) {
    for (const Instruction i : instructions) add(i);
  }

  Words words;
  std::vector<Id> calls;
  std::set<Id> removed;  // results of removed instructions

 private:
  void add(Instruction i) {
    const spv::Op op = opcode(i);
    if (op == spv::OpLabel) {
      block_ = i[1];
      live_ = first_ || reached_.count(block_) != 0;
      first_ = false;
    }
    const bool outside = op == spv::OpFunction || op == spv::OpFunctionParameter || op == spv::OpFunctionEnd;
    if (outside || live_)
      addLive(i);
    else if (const Id id = resultId(i); id != 0)
      removed.insert(id);
  }

  void addLive(Instruction i) {
    switch (opcode(i)) {
      case spv::OpSelectionMerge:  // written with the branch after it, which may be constant
        merge_ = i;
        return;
      case spv::OpLoopMerge:
        reached_.insert(i[1]);
        reached_.insert(i[2]);
        break;
      case spv::OpBranch:
        reach(i[1]);
        break;
      case spv::OpBranchConditional:
        addConditional(i);
        return;
      case spv::OpSwitch:
        addMerge();
        reach(i[2]);
        for (std::size_t at = 4; at < i.size(); at += 2) reach(i[at]);
        break;
      case spv::OpPhi:
        addPhi(i);
        return;
      case spv::OpFunctionCall:
        calls.push_back(i[3]);
        break;
      default:
        fold(i);
    }
    append(words, i);
  }

  void reach(Id target) {
    reached_.insert(target);
    edges_.insert({block_, target});
  }

  void addMerge() {
    if (merge_.empty()) return;
    reached_.insert(merge_[1]);
    append(words, merge_);
    merge_ = {};
  }

  void addConditional(Instruction i) {
    const auto known = constants_.find(i[1]);
    if (known == constants_.end()) {
      addMerge();
      reach(i[2]);
      reach(i[3]);
      append(words, i);
      return;
    }
    merge_ = {};
    const Id target = known->second ? i[2] : i[3];
    reach(target);
    append(words, Words{2u << spv::WordCountShift | spv::OpBranch, target});
  }

  // Keeps the operands of the edges that are left. glslang writes phis after what precedes them, for && and || alone.
  void addPhi(Instruction i) {
    Words phi(i.begin(), i.begin() + 3);
    std::set<int> values;  // 0, 1; 2 if unknown
    for (std::size_t at = 3; at < i.size(); at += 2) {
      if (edges_.count({i[at + 1], block_}) == 0) continue;
      phi.insert(phi.end(), {i[at], i[at + 1]});
      const auto known = constants_.find(i[at]);
      values.insert(known == constants_.end() ? 2 : static_cast<int>(known->second));
    }
    phi[0] = static_cast<std::uint32_t>(phi.size()) << spv::WordCountShift | spv::OpPhi;
    if (values.size() == 1 && *values.begin() != 2) constants_[i[2]] = *values.begin() == 1;
    append(words, phi);
  }

  // Notes a result that constants decide.
  void fold(Instruction i) {
    const auto decides = [&](Id id, bool value) {
      const auto known = constants_.find(id);
      return known != constants_.end() && known->second == value;
    };
    const auto isKnown = [&](Id id) { return constants_.count(id) != 0; };
    switch (opcode(i)) {
      case spv::OpLogicalNot:
        if (isKnown(i[3])) constants_[i[2]] = !constants_[i[3]];
        break;
      case spv::OpLogicalAnd:
        if (decides(i[3], false) || decides(i[4], false)) constants_[i[2]] = false;
        if (decides(i[3], true) && decides(i[4], true)) constants_[i[2]] = true;
        break;
      case spv::OpLogicalOr:
        if (decides(i[3], true) || decides(i[4], true)) constants_[i[2]] = true;
        if (decides(i[3], false) && decides(i[4], false)) constants_[i[2]] = false;
        break;
      default:
        break;
    }
  }

  std::map<Id, bool> constants_;
  std::set<Id> reached_;
  std::set<std::pair<Id, Id>> edges_;
  Instruction merge_;
  Id block_ = 0;
  bool first_ = true;
  bool live_ = false;
};

std::vector<Instruction> split(const Words& module) {
  std::vector<Instruction> instructions;
  for (std::size_t at = kHeaderWords; at < module.size(); at += instructions.back().size())
    instructions.push_back(Instruction(module).subspan(at, module[at] >> spv::WordCountShift));
  return instructions;
}

}  // namespace

Words withoutDeadCode(const Words& module) {
  const std::vector<Instruction> instructions = split(module);

  // Prune every function on its own.
  std::map<Id, bool> constants;
  std::map<Id, PrunedFunction> functions;
  std::vector<Id> order, entries;
  std::size_t declarations = instructions.size();
  for (std::size_t i = 0; i < instructions.size(); ++i) {
    const spv::Op op = opcode(instructions[i]);
    if (op == spv::OpConstantTrue || op == spv::OpConstantFalse)
      constants[instructions[i][2]] = op == spv::OpConstantTrue;
    if (op == spv::OpEntryPoint) entries.push_back(instructions[i][2]);
    if (op != spv::OpFunction) continue;
    if (order.empty()) declarations = i;
    std::size_t end = i;
    while (opcode(instructions[end]) != spv::OpFunctionEnd) ++end;
    order.push_back(instructions[i][2]);
    functions.emplace(order.back(), PrunedFunction(std::span(instructions).subspan(i, end + 1 - i), constants));
    i = end;
  }

  // Follow the calls from the entry points.
  std::set<Id> called;
  for (std::vector<Id> open = entries; !open.empty();) {
    const Id id = open.back();
    open.pop_back();
    if (!called.insert(id).second) continue;
    const std::vector<Id>& calls = functions.at(id).calls;
    open.insert(open.end(), calls.begin(), calls.end());
  }
  std::set<Id> removed;
  for (const auto& [id, function] : functions) {
    removed.insert(function.removed.begin(), function.removed.end());
    if (called.count(id) != 0) continue;
    for (std::size_t at = 0; at < function.words.size(); at += function.words[at] >> spv::WordCountShift)
      removed.insert(resultId(Instruction(function.words).subspan(at)));
  }

  Words out(module.begin(), module.begin() + kHeaderWords);
  for (std::size_t i = 0; i < declarations; ++i) {
    const spv::Op op = opcode(instructions[i]);
    const bool names = op == spv::OpName || op == spv::OpDecorate;
    if (!names || removed.count(instructions[i][1]) == 0) append(out, instructions[i]);
  }
  for (const Id id : order)
    if (called.count(id) != 0) out.insert(out.end(), functions.at(id).words.begin(), functions.at(id).words.end());
  return out;
}

}  // namespace malus::vulkan
