#pragma once

/// All that a program needs that computes motions: scenes and their files, motions, sweeps, aiming, comparisons,
/// reports and pages; and `solve` for a law that is a lambda. `docs/cpp.md` is the guide.

#include "trajet/ensemble/aim.hpp"
#include "trajet/ensemble/sweep.hpp"
#include "trajet/error.hpp"
#include "trajet/io/aim_json.hpp"
#include "trajet/io/compare_report.hpp"
#include "trajet/io/csv_writer.hpp"
#include "trajet/io/gltf.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/io/scene_overrides.hpp"
#include "trajet/io/scene_schema.hpp"
#include "trajet/io/sweep_plan_text.hpp"
#include "trajet/io/variation_text.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/ode/solve.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/motion.hpp"
#include "trajet/sim/names.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/study/compare.hpp"
#include "trajet/version.hpp"
#include "trajet/viz/page.hpp"
