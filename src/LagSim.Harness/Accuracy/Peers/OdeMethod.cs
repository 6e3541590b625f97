using System;
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
internal sealed class OdeMethod : SteppedEngine
{
    public override string Name => "ODE";

    public override string Engine => "ode";

    public override string? Missing => OdeLibrary.Missing;

    protected override Run Begin(WorkScene scene, double step) => new OdeRun(scene, step);

    private sealed unsafe class OdeRun : Run
    {
        private readonly nint[] bodies;
        private readonly nint world;
        private readonly nint space;
        private readonly nint contacts;
        private GCHandle self;

        internal OdeRun(WorkScene work, double step)
            : base(work, step)
        {
            OdeLibrary.UseThread();
            world = OdeLibrary.WorldCreate();
            space = OdeLibrary.HashSpaceCreate(0);
            contacts = OdeLibrary.JointGroupCreate(0);
            self = GCHandle.Alloc(this);
            OdeLibrary.WorldSetGravity(world, Scene.Gravity.X, Scene.Gravity.Y, Scene.Gravity.Z);
            for (int n = 0; n < Scene.Planes.Count; n++)
            {
                StaticPlane plane = Scene.Planes[n];
                OdeLibrary.GeomSetData(OdeLibrary.CreatePlane(space, plane.Normal.X, plane.Normal.Y, plane.Normal.Z, plane.Offset), Scene.Bodies.Count + n);
            }

            bodies = new nint[Scene.Bodies.Count];
            for (int n = 0; n < bodies.Length; n++)
            {
                SceneBody body = Scene.Bodies[n];
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

        public override Vector3D Position(int body) => Read(OdeLibrary.BodyGetPosition(bodies[body]));

        public override Vector3D Velocity(int body) => Read(OdeLibrary.BodyGetLinearVel(bodies[body]));

        public override void Dispose()
        {
            if (self.IsAllocated)
            {
                OdeLibrary.JointGroupDestroy(contacts);
                OdeLibrary.SpaceDestroy(space);
                OdeLibrary.WorldDestroy(world);
                self.Free();
            }
        }

        protected override void Step()
        {
            OdeLibrary.SpaceCollide(space, GCHandle.ToIntPtr(self), &Near);
            for (int n = 0; Work.Acting is not null && n < bodies.Length; n++)
            {
                Vector3D push = Force(n);
                OdeLibrary.BodyAddForce(bodies[n], push.X, push.Y, push.Z);
            }

            OdeLibrary.WorldQuickStep(world, StepSeconds);
            OdeLibrary.JointGroupEmpty(contacts);
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

            OdeRun run = (OdeRun)GCHandle.FromIntPtr(data).Target!;
            contact.Mode = OdeLibrary.ContactBounce;
            contact.Bounce = Math.Min(run.Restitution(OdeLibrary.GeomGetData(first)), run.Restitution(OdeLibrary.GeomGetData(second)));
            OdeLibrary.JointAttach(OdeLibrary.JointCreateContact(run.world, run.contacts, &contact), a, b);
        }

        private double Restitution(nint part) =>
            part < bodies.Length ? Scene.Bodies[(int)part].Spec.Restitution : Scene.Planes[(int)part - bodies.Length].Restitution;
    }
}
