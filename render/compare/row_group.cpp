#include "render/compare/row_group.h"

#include <sys/resource.h>

#include <fmt/format.h>

#include "render/job.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// Processor time of the whole process, all threads, in milliseconds.
double cpuMs() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

}  // namespace

std::string groupTitle(const RowGroup& group) {
  const RenderParameters& p = group.parameters;
  return fmt::format("{} {} x {}, depth {}", group.pack->scene.name, p.width, p.height, p.depth);
}

Renderer& rowRenderer(const ComparisonRow& row, RowGroup& group) {
  return group.renderers->pool(row.backend)[row.choice ? row.choice->scene : nullptr];
}

RenderParameters rowParameters(const ComparisonRow& row, const RowGroup& group) {
  RenderParameters parameters = row.choice ? row.choice->parameters : group.parameters;
  parameters.everyEffect = row.everyEffect;
  parameters.vulkanPath = row.vulkanPath;
  parameters.embreePath = row.embreePath;
  return parameters;
}

void renderTimed(ComparisonRow& row, RowGroup& group) {
  const double cpuBefore = cpuMs();
  const RenderResult result = renderImage(rowRenderer(row, group), row.method, rowParameters(row, group), false);
  row.cpuMs.push_back(cpuMs() - cpuBefore);
  row.samplesMs.push_back(result.cost.traceMs);
  row.wallMs.push_back(result.cost.wallMs);
  row.readBackMs.push_back(result.cost.readBackMs);
}

RenderResult renderFirst(ComparisonRow& row, RowGroup& group) {
  RenderResult result = renderImage(rowRenderer(row, group), row.method, rowParameters(row, group), true);
  row.buildMs = result.cost.buildMs;
  row.uploadMs = result.cost.uploadMs;
  row.compileMs = result.cost.compileMs;
  row.rays = result.cost.rays;
  row.vulkanPath = result.vulkanPath;
  row.embreePath = result.embreePath;
  row.withoutRecursion = result.withoutRecursion;
  row.payloadBytes = payloadBytes(methodNamed(row.method), row.vulkanPath);
  return result;
}

}  // namespace malus::render
