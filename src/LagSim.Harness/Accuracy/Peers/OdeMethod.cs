using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Harness.Accuracy.Peers;

/// <summary>
/// ODE through its C interface: spheres and planes in a hash space, a contact joint a touch, <c>dWorldQuickStep</c> with its defaults (20 iterations, ERP 0.2).
/// </summary>
/// <remarks>
/// Its other stepper, <c>dWorldStep</c>, complains of internal errors of its solver on some of the scenes. No friction, restitution at any speed
/// (<c>bounce_vel</c> 0), no automatic disabling (its default), no damping (its default). A force is added before each step.
/// </remarks>
internal sealed class OdeMethod : IWorkMethod
{
    public string Name => "ODE";

    public string Engine => "ode";

    public string? Missing => OdeLibrary.Missing;

    public string? Excludes(WorkScene scene) => null;

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => [.. scene.EngineRates.Select(WorkSetting.Rate)];

    public IWorkRun Start(WorkScene scene, WorkSetting setting) => new Run(scene, setting.StepSeconds);

    private sealed unsafe class Run : IWorkRun
    {
        private readonly Scene scene;
        private readonly WorkScene work;
        private readonly double step;
        private readonly nint[] bodies;
        private readonly nint world;
        private readonly nint space;
        private readonly nint contacts;
        private GCHandle self;

        internal Run(WorkScene work, double step)
        {
            scene = work.Scene;
            this.work = work;
            this.step = step;
            OdeLibrary.UseThread();
            world = OdeLibrary.WorldCreate();
            space = OdeLibrary.HashSpaceCreate(0);
            contacts = OdeLibrary.JointGroupCreate(0);
            self = GCHandle.Alloc(this);
            OdeLibrary.WorldSetGravity(world, scene.Gravity.X, scene.Gravity.Y, scene.Gravity.Z);
            for (int n = 0; n < scene.Planes.Count; n++)
            {
                StaticPlane plane = scene.Planes[n];
                OdeLibrary.GeomSetData(OdeLibrary.CreatePlane(space, plane.Normal.X, plane.Normal.Y, plane.Normal.Z, plane.Offset), scene.Bodies.Count + n);
            }

            bodies = new nint[scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = scene.Bodies[n];
                nint ball = bodies[n] = OdeLibrary.BodyCreate(world);
                OdeLibrary.Mass mass;
                OdeLibrary.MassSetSphereTotal(&mass, body.Spec.Mass, body.Spec.Radius);
                OdeLibrary.BodySetMass(ball, &mass);
                OdeLibrary.BodySetPosition(ball, body.Position.X, body.Position.Y, body.Position.Z);
                OdeLibrary.BodySetLinearVel(ball, body.Velocity.X, body.Velocity.Y, body.Velocity.Z);
                nint sphere = OdeLibrary.CreateSphere(space, body.Spec.Radius);
                OdeLibrary.GeomSetBody(sphere, ball);
                OdeLibrary.GeomSetData(sphere, n);
            }
        }

        public double Seconds => Events * step;

        public long Events { get; private set; }

        public void AdvanceTo(double seconds)
        {
            for (long end = (long)Math.Round(seconds / step); Events < end; Events++)
            {
                OdeLibrary.SpaceCollide(space, GCHandle.ToIntPtr(self), &Near);
                for (int n = 0; work.Acting is not null && n < bodies.Length; n++)
                {
                    double mass = scene.Bodies[n].Spec.Mass;
                    Vector3D push = work.Push(mass, Seconds, Position(n), Velocity(n)) * mass;
                    OdeLibrary.BodyAddForce(bodies[n], push.X, push.Y, push.Z);
                }

                OdeLibrary.WorldQuickStep(world, step);
                OdeLibrary.JointGroupEmpty(contacts);
            }
        }

        public Vector3D Position(int body) => Read(OdeLibrary.BodyGetPosition(bodies[body]));

        public Vector3D Velocity(int body) => Read(OdeLibrary.BodyGetLinearVel(bodies[body]));

        public void Dispose()
        {
            if (self.IsAllocated)
            {
                OdeLibrary.JointGroupDestroy(contacts);
                OdeLibrary.SpaceDestroy(space);
                OdeLibrary.WorldDestroy(world);
                self.Free();
            }
        }

        private static Vector3D Read(double* v) => new(v[0], v[1], v[2]);

        [UnmanagedCallersOnly(CallConvs = [typeof(CallConvCdecl)])]
        private static void Near(nint data, nint first, nint second)
        {
            (nint a, nint b) = (OdeLibrary.GeomGetBody(first), OdeLibrary.GeomGetBody(second));
            OdeLibrary.Contact contact = default;
            if ((a | b) == 0 || OdeLibrary.Collide(first, second, 1, &contact.Geom, sizeof(OdeLibrary.Contact)) == 0)
            {
                return;
            }

            Run run = (Run)GCHandle.FromIntPtr(data).Target!;
            contact.Mode = OdeLibrary.ContactBounce;
            contact.Bounce = Math.Min(run.Restitution(OdeLibrary.GeomGetData(first)), run.Restitution(OdeLibrary.GeomGetData(second)));
            OdeLibrary.JointAttach(OdeLibrary.JointCreateContact(run.world, run.contacts, &contact), a, b);
        }

        private double Restitution(nint part) =>
            part < bodies.Length ? scene.Bodies[(int)part].Spec.Restitution : scene.Planes[(int)part - bodies.Length].Restitution;
    }
}
