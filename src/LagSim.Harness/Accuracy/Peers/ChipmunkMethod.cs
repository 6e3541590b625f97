using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Harness.Accuracy.Peers;

/// <summary>
/// Chipmunk 7 through its C interface, for scenes that are plane: circles and thick segments, all else by default (10 iterations, no damping, no sleeping).
/// </summary>
/// <remarks>
/// It multiplies the elasticities of two shapes, where LagSim takes the lesser; they are set so that the products are what the scene asks for. Friction is zero
/// by default. A force is set where the velocity is updated, after the places are, as Chipmunk's own examples do.
/// </remarks>
internal sealed class ChipmunkMethod : IWorkMethod
{
    public string Name => "Chipmunk";

    public string Engine => "chipmunk";

    public string? Missing => ChipmunkLibrary.Missing;

    public string? Excludes(WorkScene scene) => scene.Flat(Vector3D.Zero, 0) is null ? "it is two-dimensional, and the scene is not" : null;

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => [.. scene.EngineRates.Select(WorkSetting.Rate)];

    public IWorkRun Start(WorkScene scene, WorkSetting setting) => new Run(scene, setting.StepSeconds);

    private sealed unsafe class Run : IWorkRun
    {
        /// <summary>Walls are this thick, so that nothing gets through them in a step.</summary>
        private const double Thick = 5;

        private readonly WorkScene work;
        private readonly Scene scene;
        private readonly double step;
        private readonly nint[] bodies;
        private readonly List<nint> shapes = [];
        private nint space;
        private GCHandle self;

        internal Run(WorkScene work, double step)
        {
            this.work = work;
            this.step = step;
            self = GCHandle.Alloc(this);
            scene = work.Scene;
            ChipmunkLibrary.Begin();
            space = ChipmunkLibrary.SpaceNew();
            (double gx, double gy) = work.FlatNormal(scene.Gravity);
            ChipmunkLibrary.SpaceSetGravity(space, new(gx, gy));
            double elasticity = Math.Sqrt(scene.Bodies[0].Spec.Restitution); // that of two balls is its square
            foreach (StaticPlane plane in scene.Planes)
            {
                AddWall(plane, Math.Min(plane.Restitution, scene.Bodies[0].Spec.Restitution) / elasticity);
            }

            bodies = new nint[scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = scene.Bodies[n];
                (double x, double y) = work.Flat(body.Position, n)!.Value;
                (double vx, double vy) = work.FlatNormal(body.Velocity);
                nint ball = bodies[n] = ChipmunkLibrary.SpaceAddBody(space,
                    ChipmunkLibrary.BodyNew(body.Spec.Mass, 0.5 * body.Spec.Mass * body.Spec.Radius * body.Spec.Radius));
                ChipmunkLibrary.BodySetPosition(ball, new(x, y));
                ChipmunkLibrary.BodySetVelocity(ball, new(vx, vy));
                if (work.Acting is not null)
                {
                    ChipmunkLibrary.BodySetUserData(ball, GCHandle.ToIntPtr(self));
                    ChipmunkLibrary.BodySetVelocityUpdateFunc(ball, &UpdateVelocity);
                }

                Add(ChipmunkLibrary.CircleShapeNew(ball, body.Spec.Radius, default), elasticity);
            }
        }

        public double Seconds => Events * step;

        public long Events { get; private set; }

        public void AdvanceTo(double seconds)
        {
            for (long end = (long)Math.Round(seconds / step); Events < end; Events++)
            {
                ChipmunkLibrary.SpaceStep(space, step);
            }
        }

        public Vector3D Position(int body)
        {
            ChipmunkLibrary.Vect at = ChipmunkLibrary.BodyGetPosition(bodies[body]);
            return work.Unflat(at.X, at.Y, body);
        }

        public Vector3D Velocity(int body)
        {
            ChipmunkLibrary.Vect v = ChipmunkLibrary.BodyGetVelocity(bodies[body]);
            return work.Unflat(v.X, v.Y, body) - work.Unflat(0, 0, body);
        }

        public void Dispose()
        {
            if (space == 0)
            {
                return;
            }

            foreach (nint shape in shapes)
            {
                ChipmunkLibrary.SpaceRemoveShape(space, shape);
                ChipmunkLibrary.ShapeFree(shape);
            }

            foreach (nint body in bodies)
            {
                ChipmunkLibrary.SpaceRemoveBody(space, body);
                ChipmunkLibrary.BodyFree(body);
            }

            ChipmunkLibrary.SpaceFree(space);
            space = 0;
            self.Free();
        }

        /// <summary>A long segment behind the surface, so thick that its rounded edge is the surface.</summary>
        private void AddWall(StaticPlane plane, double elasticity)
        {
            const double half = 1000;
            (double x, double y) = work.FlatNormal(plane.Normal);
            if (x == 0 && y == 0)
            {
                return; // it is the plane itself
            }

            double behind = plane.Offset - Thick;
            Add(
                ChipmunkLibrary.SegmentShapeNew(
                    ChipmunkLibrary.SpaceGetStaticBody(space), new((x * behind) - (y * half), (y * behind) + (x * half)),
                        new((x * behind) + (y * half), (y * behind) - (x * half)), Thick),
                elasticity);
        }

        [UnmanagedCallersOnly(CallConvs = [typeof(CallConvCdecl)])]
        private static void UpdateVelocity(nint body, ChipmunkLibrary.Vect gravity, double damping, double step)
        {
            Run run = (Run)GCHandle.FromIntPtr(ChipmunkLibrary.BodyGetUserData(body)).Target!;
            int n = Array.IndexOf(run.bodies, body);
            (double x, double y) = run.work.FlatNormal(run.work.Push(run.scene.Bodies[n].Spec.Mass, run.Seconds, run.Position(n), run.Velocity(n)) * run.scene.Bodies[n].Spec.Mass);
            ChipmunkLibrary.BodySetForce(body, new(x, y));
            ChipmunkLibrary.BodyUpdateVelocity(body, gravity, damping, step);
        }

        private void Add(nint shape, double elasticity)
        {
            ChipmunkLibrary.ShapeSetElasticity(shape, elasticity);
            ChipmunkLibrary.SpaceAddShape(space, shape);
            shapes.Add(shape);
        }
    }
}
