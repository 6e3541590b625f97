using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// ODE through its C interface: spheres and planes in a hash space, a contact joint a touch, <c>dWorldQuickStep</c> with its defaults (20
/// iterations, ERP 0.2), or <c>dWorldStep</c>, which solves each step directly.
/// </summary>
/// <remarks>
/// <c>dWorldStep</c> complains of internal errors of its solver on some of the scenes; what it says is not shown. Friction where the scene
/// has it, the lesser of two, as a pyramid about Coulomb's cone (<c>dContactApprox1</c>); restitution at any speed (<c>bounce_vel</c> 0),
/// no automatic disabling (its default), no damping (its default). A force is added before each step. <c>dWorldQuickStep</c> takes contacts
/// in a random order; its seed is the same for every run.
/// </remarks>
/// <param name="isDirect">Whether it uses <c>dWorldStep</c>.</param>
internal sealed class OdeMethod(bool isDirect = false) : SteppedEngine
{
    private const int MaxContactsOfDirectSolver = 64;

    public override string Name => isDirect ? "ODE dWorldStep" : "ODE";

    public override string Engine => "ode";

    public override string? Missing => OdeLibrary.Missing;

    public override string? Excludes(WorkScene scene) =>
        !isDirect ? null
        : scene is not ContactWork ? "where impacts are few the other stepper is as good, and this one complains of internal errors"
        : scene is RandomHeapWork ? "heap and pyramid tell enough of it, and it is slow"
        : scene.Scene.Bodies.Count > MaxContactsOfDirectSolver ? "its cost grows with the cube of the contacts" : null;

    protected override Run Begin(WorkScene scene, double step) => new OdeRun(scene, step, isDirect);

    private sealed unsafe class OdeRun : Run
    {
        private readonly nint[] bodies;
        private readonly nint world;
        private readonly nint space;
        private readonly nint contacts;
        private readonly bool isDirect;
        private GCHandle self;

        internal OdeRun(WorkScene work, double step, bool isDirect)
            : base(work, step)
        {
            this.isDirect = isDirect;
            OdeLibrary.UseThread();
            OdeLibrary.Begin();
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

            for (int n = 0; n < Scene.StaticSpheres.Count; n++)
            {
                StaticSphere fixedOne = Scene.StaticSpheres[n];
                nint sphere = OdeLibrary.CreateSphere(space, fixedOne.Radius);
                OdeLibrary.GeomSetPosition(sphere, fixedOne.Centre.X, fixedOne.Centre.Y, fixedOne.Centre.Z);
                OdeLibrary.GeomSetData(sphere, Scene.Bodies.Count + Scene.Planes.Count + n);
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

        public override Vector3D Spin(int body) => Read(OdeLibrary.BodyGetAngularVel(bodies[body]));

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

            if (isDirect)
            {
                OdeLibrary.WorldStep(world, StepSeconds);
            }
            else
            {
                OdeLibrary.WorldQuickStep(world, StepSeconds);
            }

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
            ((double restitution, double friction), (double Restitution, double Friction) other) =
                (run.Surface((int)OdeLibrary.GeomGetData(first)), run.Surface((int)OdeLibrary.GeomGetData(second)));
            contact.Bounce = Math.Min(restitution, other.Restitution);
            contact.Friction = Math.Min(friction, other.Friction);
            contact.Mode = OdeLibrary.ContactBounce | (contact.Friction > 0 ? OdeLibrary.ContactApprox1 : 0);
            OdeLibrary.JointAttach(OdeLibrary.JointCreateContact(run.world, run.contacts, &contact), a, b);
        }

        /// <summary>
        /// Returns the restitution and friction of a part. Parts are numbered: bodies first, then planes, then static spheres.
        /// </summary>
        private (double Restitution, double Friction) Surface(int part)
        {
            int plane = part - bodies.Length, sphere = plane - Scene.Planes.Count;
            return plane < 0 ? (Scene.Bodies[part].Spec.Restitution, Scene.Bodies[part].Spec.Friction)
                : sphere < 0 ? (Scene.Planes[plane].Restitution, Scene.Planes[plane].Friction)
                : (Scene.StaticSpheres[sphere].Restitution, Scene.StaticSpheres[sphere].Friction);
        }
    }
}
