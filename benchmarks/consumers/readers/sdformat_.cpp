// Prints what libsdformat holds of the model in a file, as lines of a kind, names and numbers; errors to standard error.
// Built and read by sdformat_.py.
#include <cstdio>
#include <sdf/sdf.hh>

static void frame(const ignition::math::Pose3d &p) {
  std::printf(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g", p.Pos().X(), p.Pos().Y(), p.Pos().Z(), p.Rot().X(), p.Rot().Y(),
              p.Rot().Z(), p.Rot().W());
}

int main(int, char **given) {
  sdf::Root root;
  for (const auto &error : root.Load(given[1])) std::fprintf(stderr, "%s\n", error.Message().c_str());
  const sdf::Model *model = root.Model();
  if (!model) return 1;
  std::printf("version %s\n", SDF_VERSION_FULL);
  for (uint64_t k = 0; k < model->LinkCount(); ++k) {
    const sdf::Link *link = model->LinkByIndex(k);
    ignition::math::Pose3d at;
    for (const auto &error : link->SemanticPose().Resolve(at, "__model__")) std::fprintf(stderr, "%s\n", error.Message().c_str());
    const auto inertia = link->Inertial();
    const auto I = inertia.MassMatrix();
    std::printf("link %s", link->Name().c_str());
    frame(at);
    frame(inertia.Pose());
    std::printf(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", I.Mass(), I.Ixx(), I.Iyy(), I.Izz(), I.Ixy(), I.Ixz(), I.Iyz());
  }
  for (uint64_t k = 0; k < model->JointCount(); ++k) {
    const sdf::Joint *joint = model->JointByIndex(k);
    std::string parent, child;
    joint->ResolveParentLink(parent);
    joint->ResolveChildLink(child);
    ignition::math::Pose3d at;
    joint->SemanticPose().Resolve(at, "__model__");
    std::printf("joint %s %d %s %s", joint->Name().c_str(), static_cast<int>(joint->Type()), parent.c_str(), child.c_str());
    frame(at);
    if (const sdf::JointAxis *axis = joint->Axis()) {
      ignition::math::Vector3d xyz;
      axis->ResolveXyz(xyz, "__model__");
      std::printf(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g", xyz.X(), xyz.Y(), xyz.Z(), axis->Lower(),
                  axis->Upper(), axis->Effort(), axis->MaxVelocity(), axis->Damping(), axis->Friction(), axis->SpringStiffness(),
                  axis->SpringReference());
    }
    std::printf("\n");
  }
}
