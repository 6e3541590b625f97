using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>
/// BepuPhysics 2.5, in single precision: spheres, walls as boxes, one iteration on each of 8 substeps as in its own example of bouncing, on
/// one thread.
/// </summary>
/// <remarks>
/// It has no restitution: a contact is a damped spring. The spring's damping ratio z is what leaves the scene's restitution to half a
/// swing, e = exp(-pi z / sqrt(1 - z^2)), and nothing limits how fast it pushes out. A stiff spring loses energy to the solver's step, a
/// soft one holds the ball for long; both fall alike with finer steps where the frequency goes with the root of the rate, by
/// <see cref="Stiffness"/> (docs/ACCURACY.md has what was tried). Friction is that of the scene's balls everywhere. No sleeping. A force is
/// an impulse before each step.
/// </remarks>
internal sealed class BepuMethod : SteppedEngine
{
    /// <summary>The spring's frequency in Hz divided by the root of the steps per second.</summary>
    private const double Stiffness = 0.5;

    public override string Name => "BepuPhysics";

    public override string Engine => "bepu";

    public override string? Excludes(WorkScene scene) => BoxWall.Excludes(scene.Scene);

    protected override Run Begin(WorkScene scene, double step) => new BepuRun(scene, step);

    private sealed class BepuRun : Run
    {
        private const int Substeps = 8;

        private readonly BufferPool pool = new();
        private readonly BepuPhysics.Simulation world;
        private readonly BodyHandle[] bodies;

        internal BepuRun(WorkScene work, double step)
            : base(work, step)
        {
            float frequency = (float)(Stiffness / Math.Sqrt(step));
            BepuContacts contacts = new()
            {
                Friction = (float)Scene.Bodies[0].Spec.Friction,
                Balls = new SpringSettings(frequency, Damping(Scene.Bodies[0].Spec.Restitution)),
                Walls = Array.ConvertAll([.. Scene.Planes], plane => new SpringSettings(frequency, Damping(RestitutionAt(plane)))),
            };
            world = BepuPhysics.Simulation.Create(pool, contacts, new BepuGravity { Gravity = Vector(Scene.Gravity) }, new SolveDescription(1, Substeps));
            foreach (StaticPlane plane in Scene.Planes)
            {
                (Vector3D centre, Vector3D sides) = BoxWall.Of(plane);
                Vector3 box = Vector(sides);
                world.Statics.Add(new StaticDescription(Vector(centre), Quaternion.Identity, world.Shapes.Add(new Box(box.X, box.Y, box.Z))));
            }

            bodies = new BodyHandle[Scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = Scene.Bodies[n];
                Sphere ball = new((float)body.Spec.Radius);
                bodies[n] = world.Bodies.Add(BodyDescription.CreateDynamic(
                    new RigidPose(Vector(body.Position)), new BodyVelocity(Vector(body.Velocity)), ball.ComputeInertia((float)body.Spec.Mass), world.Shapes.Add(ball),
                    new BodyActivityDescription(-1)));
            }
        }

        public override Vector3D Position(int body) => Read(world.Bodies[bodies[body]].Pose.Position);

        public override Vector3D Velocity(int body) => Read(world.Bodies[bodies[body]].Velocity.Linear);

        public override Vector3D Spin(int body) => Read(world.Bodies[bodies[body]].Velocity.Angular);

        public override void Dispose()
        {
            world.Dispose();
            pool.Clear();
        }

        protected override void Step()
        {
            for (int n = 0; Work.Acting is not null && n < bodies.Length; n++)
            {
                world.Bodies[bodies[n]].ApplyLinearImpulse(Vector(Force(n) * StepSeconds));
            }

            world.Timestep((float)StepSeconds);
        }

        private static float Damping(double restitution)
        {
            double log = Math.Log(Math.Max(restitution, 1e-9)); // zero restitution is critical damping
            return (float)(-log / Math.Sqrt((Math.PI * Math.PI) + (log * log)));
        }

        private static Vector3 Vector(in Vector3D v) => new((float)v.X, (float)v.Y, (float)v.Z);

        private static Vector3D Read(in Vector3 v) => new(v.X, v.Y, v.Z);
    }
}
