using System.Linq;
using Jitter2;
using Jitter2.Collision.Shapes;
using Jitter2.Dynamics;
using Jitter2.LinearMath;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>
/// Jitter2 in double precision: spheres, walls as boxes, all else by default (6 iterations and 4 of relaxation, no substeps), on one
/// thread.
/// </summary>
/// <remarks>
/// Set as the scenes ask for: no damping, no sleeping. It takes the greater of two frictions and of two restitutions, and none below 1 m/s,
/// which cannot be changed. A force is an impulse before each step: added as a force it would act a step later.
/// </remarks>
internal sealed class JitterMethod : SteppedEngine
{
    public override string Name => "Jitter2";

    public override string Engine => "jitter";

    public override string? Excludes(WorkScene scene) =>
        scene.Scene.Planes.Any(plane => plane.Restitution < scene.Scene.Bodies[0].Spec.Restitution)
            ? "it takes the greater of two restitutions, and here walls have less than balls"
            : BoxWall.Excludes(scene.Scene);

    protected override Run Begin(WorkScene scene, double step) => new JitterRun(scene, step);

    private sealed class JitterRun : Run
    {
        private readonly World world = new() { AllowDeactivation = false };
        private readonly RigidBody[] bodies;

        internal JitterRun(WorkScene work, double step)
            : base(work, step)
        {
            world.Gravity = Vector(Scene.Gravity);
            foreach (StaticPlane plane in Scene.Planes)
            {
                (Vector3D centre, Vector3D sides) = BoxWall.Of(plane);
                RigidBody wall = Add(new BoxShape(Vector(sides)), centre, RestitutionAt(plane), FrictionAt(plane));
                wall.MotionType = MotionType.Static;
            }

            bodies = new RigidBody[Scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = Scene.Bodies[n];
                BodySpec spec = body.Spec;
                RigidBody ball = bodies[n] = Add(new SphereShape(spec.Radius), body.Position, spec.Restitution, spec.Friction);
                ball.SetMassInertia(body.Spec.Mass);
                ball.Damping = (0, 0);
                ball.Velocity = Vector(body.Velocity);
            }
        }

        public override Vector3D Position(int body) => Read(bodies[body].Position);

        public override Vector3D Velocity(int body) => Read(bodies[body].Velocity);

        public override Vector3D Spin(int body) => Read(bodies[body].AngularVelocity);

        public override void Dispose() => world.Dispose();

        protected override void Step()
        {
            for (int n = 0; Work.Acting is not null && n < bodies.Length; n++)
            {
                bodies[n].ApplyImpulse(Vector(Force(n) * StepSeconds));
            }

            world.Step(StepSeconds, multiThread: false);
        }

        private static JVector Vector(in Vector3D v) => new(v.X, v.Y, v.Z);

        private static Vector3D Read(in JVector v) => new(v.X, v.Y, v.Z);

        private RigidBody Add(RigidBodyShape shape, in Vector3D position, double restitution, double friction)
        {
            RigidBody body = world.CreateRigidBody();
            body.AddShape(shape);
            body.Position = Vector(position);
            body.Friction = friction;
            body.Restitution = restitution;
            return body;
        }
    }
}
