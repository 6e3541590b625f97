using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// Chipmunk 7 through its C interface, for scenes that are plane: circles and thick segments, all else by default (10 iterations, no
/// damping, no sleeping).
/// </summary>
/// <remarks>
/// It multiplies the elasticities of two shapes, and their frictions, where LagSim takes the lesser; they are set so that the products are
/// what the scene asks for. In scenes of dense contact the overlap that it allows, by default 0.1 m, is the scene's contact tolerance. A
/// force is set where the velocity is updated, after the places are, as Chipmunk's own examples do.
/// </remarks>
internal sealed class ChipmunkMethod : FlatEngine
{
    public override string Name => "Chipmunk";

    public override string Engine => "chipmunk";

    public override string? Missing => ChipmunkLibrary.Missing;

    protected override Run Begin(WorkScene scene, double step) => new ChipmunkRun(scene, step);

    private sealed unsafe class ChipmunkRun : FlatRun
    {
        /// <summary>The thickness of walls, so that nothing tunnels through in a step.</summary>
        private const double Thick = 5;

        private readonly nint[] bodies;
        private readonly List<nint> shapes = [];
        private nint space;
        private GCHandle self;

        internal ChipmunkRun(WorkScene work, double step)
            : base(work, step)
        {
            self = GCHandle.Alloc(this);
            ChipmunkLibrary.Begin();
            space = ChipmunkLibrary.SpaceNew();
            (double gx, double gy) = FlatDirection(Scene.Gravity);
            ChipmunkLibrary.SpaceSetGravity(space, new(gx, gy));
            if (Work is ContactWork)
            {
                ChipmunkLibrary.SpaceSetCollisionSlop(space, Scene.ContactTolerance);
            }

            double elasticity = Math.Sqrt(Scene.Bodies[0].Spec.Restitution); // two balls multiply it
            double friction = Math.Sqrt(Scene.Bodies[0].Spec.Friction);
            foreach (StaticPlane plane in Scene.Planes)
            {
                AddWall(plane, RestitutionAt(plane) / elasticity, friction > 0 ? FrictionAt(plane) / friction : 0);
            }

            bodies = new nint[Scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = Scene.Bodies[n];
                (double x, double y) = FlatStart(n);
                (double vx, double vy) = FlatDirection(body.Velocity);
                nint ball = bodies[n] = ChipmunkLibrary.SpaceAddBody(space,
                    ChipmunkLibrary.BodyNew(body.Spec.Mass, 0.4 * body.Spec.Mass * body.Spec.Radius * body.Spec.Radius));
                ChipmunkLibrary.BodySetPosition(ball, new(x, y));
                ChipmunkLibrary.BodySetVelocity(ball, new(vx, vy));
                if (Work.Acting is not null)
                {
                    ChipmunkLibrary.BodySetUserData(ball, GCHandle.ToIntPtr(self));
                    ChipmunkLibrary.BodySetVelocityUpdateFunc(ball, &UpdateVelocity);
                }

                Add(ChipmunkLibrary.CircleShapeNew(ball, body.Spec.Radius, default), elasticity, friction);
            }
        }

        public override void Dispose()
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

        protected override void Step() => ChipmunkLibrary.SpaceStep(space, StepSeconds);

        protected override (double X, double Y) FlatPosition(int body)
        {
            ChipmunkLibrary.Vect at = ChipmunkLibrary.BodyGetPosition(bodies[body]);
            return (at.X, at.Y);
        }

        protected override (double X, double Y) FlatVelocity(int body)
        {
            ChipmunkLibrary.Vect v = ChipmunkLibrary.BodyGetVelocity(bodies[body]);
            return (v.X, v.Y);
        }

        /// <summary>A long segment behind the surface, with its rounded edge on the surface.</summary>
        private void AddWall(StaticPlane plane, double elasticity, double friction)
        {
            if (Line(plane, Thick) is ({ } from, { } to))
            {
                nint ground = ChipmunkLibrary.SpaceGetStaticBody(space);
                Add(ChipmunkLibrary.SegmentShapeNew(ground, new(from.X, from.Y), new(to.X, to.Y), Thick), elasticity, friction);
            }
        }

        protected override double FlatSpin(int body) => ChipmunkLibrary.BodyGetAngularVelocity(bodies[body]);

        [UnmanagedCallersOnly(CallConvs = [typeof(CallConvCdecl)])]
        private static void UpdateVelocity(nint body, ChipmunkLibrary.Vect gravity, double damping, double step)
        {
            ChipmunkRun run = (ChipmunkRun)GCHandle.FromIntPtr(ChipmunkLibrary.BodyGetUserData(body)).Target!;
            (double x, double y) = run.FlatDirection(run.Force(Array.IndexOf(run.bodies, body)));
            ChipmunkLibrary.BodySetForce(body, new(x, y));
            ChipmunkLibrary.BodyUpdateVelocity(body, gravity, damping, step);
        }

        private void Add(nint shape, double elasticity, double friction)
        {
            ChipmunkLibrary.ShapeSetFriction(shape, friction);
            ChipmunkLibrary.ShapeSetElasticity(shape, elasticity);
            ChipmunkLibrary.SpaceAddShape(space, shape);
            shapes.Add(shape);
        }
    }
}
