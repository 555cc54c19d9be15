#include "kinetics/stiff_solver.hpp"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <type_traits>

#include "framework/base/error.hpp"

namespace sluice::kinetics {
namespace {

static_assert(std::is_same_v<realtype, double>, "SUNDIALS with another type of real numbers");

constexpr long max_steps = 200'000;

int slopes(realtype, N_Vector y, N_Vector f, void* system) {
  const bool good = static_cast<StiffSystem*>(system)->slopes(NV_DATA_S(y), NV_DATA_S(f));
  return good ? 0 : 1;
}

void keep_quiet(int, const char*, const char*, char*, void*) {}

int jacobian(realtype, N_Vector y, N_Vector, SUNMatrix matrix, void* system, N_Vector, N_Vector,
             N_Vector) {
  static_cast<StiffSystem*>(system)->jacobian(NV_DATA_S(y), SM_COLS_D(matrix));
  return 0;
}

void keep_message(int, const char*, const char*, char* message, void* text) {
  *static_cast<std::string*>(text) = message;
}

}  // namespace

struct StiffSolver::Parts {
  SUNContext context = nullptr;
  N_Vector y = nullptr, start = nullptr, absolute = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* cvode = nullptr;
  void* erk = nullptr;
  std::string message;

  Parts() = default;
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    CVodeFree(&cvode);
    ERKStepFree(&erk);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (absolute != nullptr) N_VDestroy(absolute);
    if (start != nullptr) N_VDestroy(start);
    if (y != nullptr) N_VDestroy(y);
    SUNContext_Free(&context);
  }
};

StiffSolver::StiffSolver(StiffSystem& system, std::size_t unknowns)
    : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  const auto size = static_cast<sunindextype>(unknowns);
  const auto made = [](bool good) {
    if (!good) throw SystemError("CVODE cannot be set up: is there too little memory?");
  };
  made(SUNContext_Create(nullptr, &p.context) == 0);
  made((p.y = N_VNew_Serial(size, p.context)) != nullptr);
  made((p.start = N_VNew_Serial(size, p.context)) != nullptr);
  made((p.absolute = N_VNew_Serial(size, p.context)) != nullptr);
  made((p.matrix = SUNDenseMatrix(size, size, p.context)) != nullptr);
  made((p.linear = SUNLinSol_Dense(p.y, p.matrix, p.context)) != nullptr);
  made((p.cvode = CVodeCreate(CV_BDF, p.context)) != nullptr);
  N_VConst(0.0, p.y);
  made(CVodeSetErrHandlerFn(p.cvode, keep_message, &p.message) == CV_SUCCESS);
  made(CVodeInit(p.cvode, slopes, 0.0, p.y) == CV_SUCCESS);
  made(CVodeSetUserData(p.cvode, &system) == CV_SUCCESS);
  made(CVodeSetMaxNumSteps(p.cvode, max_steps) == CV_SUCCESS);
  made(CVodeSetLinearSolver(p.cvode, p.linear, p.matrix) == CV_SUCCESS);
  made(CVodeSetJacFn(p.cvode, jacobian) == CV_SUCCESS);
  made((p.erk = ERKStepCreate(slopes, 0.0, p.y, p.context)) != nullptr);
  made(ERKStepSetUserData(p.erk, &system) == ARK_SUCCESS);
  made(ERKStepSetErrHandlerFn(p.erk, keep_quiet, nullptr) == ARK_SUCCESS);
  made(ERKStepSetTableNum(p.erk, ARKODE_DORMAND_PRINCE_7_4_5) == ARK_SUCCESS);
  made(ERKStepSetMaxErrTestFails(p.erk, 1) == ARK_SUCCESS);
  made(ERKStepSetMaxNumSteps(p.erk, 1) == ARK_SUCCESS);
}

StiffSolver::~StiffSolver() = default;

double* StiffSolver::unknowns() {
  return NV_DATA_S(parts_->y);
}
double* StiffSolver::absolute_tolerances() {
  return NV_DATA_S(parts_->absolute);
}

// False: y is as it was.
bool StiffSolver::one_explicit_step(double dt, double relative) {
  Parts& p = *parts_;
  N_VScale(1.0, p.y, p.start);
  double reached = 0;
  const bool done = ERKStepReInit(p.erk, slopes, 0.0, p.y) == ARK_SUCCESS &&
                    ERKStepSVtolerances(p.erk, relative, p.absolute) == ARK_SUCCESS &&
                    ERKStepSetInitStep(p.erk, dt) == ARK_SUCCESS &&
                    ERKStepSetStopTime(p.erk, dt) == ARK_SUCCESS &&
                    ERKStepEvolve(p.erk, dt, p.y, &reached, ARK_NORMAL) >= 0 && reached == dt;
  if (!done) N_VScale(1.0, p.start, p.y);
  return done;
}

StiffSolver::Outcome StiffSolver::advance(double dt, double relative) {
  Parts& p = *parts_;
  Outcome outcome;
  if (one_explicit_step(dt, relative)) return {true, dt, 1, {}};
  p.message.clear();
  double reached = 0;
  // The stop time keeps the last step from going past dt: the end is a step, not interpolated.
  const bool set = CVodeReInit(p.cvode, 0.0, p.y) == CV_SUCCESS &&
                   CVodeSVtolerances(p.cvode, relative, p.absolute) == CV_SUCCESS &&
                   CVodeSetStopTime(p.cvode, dt) == CV_SUCCESS;
  outcome.good = set && CVode(p.cvode, dt, p.y, &reached, CV_NORMAL) >= 0;
  CVodeGetNumSteps(p.cvode, &outcome.steps);
  CVodeGetLastStep(p.cvode, &outcome.last_step);
  if (!outcome.good)
    outcome.problem = fmt::format("{} (at {:g} s of {:g} s)", p.message, reached, dt);
  return outcome;
}

}  // namespace sluice::kinetics
