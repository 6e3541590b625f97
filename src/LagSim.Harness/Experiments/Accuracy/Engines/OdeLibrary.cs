using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>The parts of ODE's C interface in use (ode/ode.h of version 0.16), in double precision.</summary>
/// <remarks>A vector of ODE has four numbers, of which the last is padding; a matrix twelve.</remarks>
internal static unsafe class OdeLibrary
{
    private static readonly NativeFunctions Library = new("libode.so.8", "libode.so", "libode.8.dylib", "libode.dylib", "ode_double.dll", "ode.dll");

    internal static readonly delegate* unmanaged[Cdecl]<nint> WorldCreate = (delegate* unmanaged[Cdecl]<nint>)Library.Find("dWorldCreate");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> WorldDestroy = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("dWorldDestroy");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, void> WorldSetGravity =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, void>)Library.Find("dWorldSetGravity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, int> WorldQuickStep =
        (delegate* unmanaged[Cdecl]<nint, double, int>)Library.Find("dWorldQuickStep");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, int> WorldStep =
        (delegate* unmanaged[Cdecl]<nint, double, int>)Library.Find("dWorldStep");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> BodyCreate = (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("dBodyCreate");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, void> BodySetPosition =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, void>)Library.Find("dBodySetPosition");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, void> BodySetLinearVel =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, void>)Library.Find("dBodySetLinearVel");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, void> BodyAddForce =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, void>)Library.Find("dBodyAddForce");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double*> BodyGetPosition =
        (delegate* unmanaged[Cdecl]<nint, double*>)Library.Find("dBodyGetPosition");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double*> BodyGetLinearVel =
        (delegate* unmanaged[Cdecl]<nint, double*>)Library.Find("dBodyGetLinearVel");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double*> BodyGetAngularVel =
        (delegate* unmanaged[Cdecl]<nint, double*>)Library.Find("dBodyGetAngularVel");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Mass*, void> BodySetMass =
        (delegate* unmanaged[Cdecl]<nint, Mass*, void>)Library.Find("dBodySetMass");
    internal static readonly delegate* unmanaged[Cdecl]<Mass*, double, double, void> MassSetSphereTotal =
        (delegate* unmanaged[Cdecl]<Mass*, double, double, void>)Library.Find("dMassSetSphereTotal");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> HashSpaceCreate = (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("dHashSpaceCreate");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> SpaceDestroy = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("dSpaceDestroy");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, delegate* unmanaged[Cdecl]<nint, nint, nint, void>, void> SpaceCollide =
        (delegate* unmanaged[Cdecl]<nint, nint, delegate* unmanaged[Cdecl]<nint, nint, nint, void>, void>)Library.Find("dSpaceCollide");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, int, ContactGeom*, int, int> Collide =
        (delegate* unmanaged[Cdecl]<nint, nint, int, ContactGeom*, int, int>)Library.Find("dCollide");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, nint> CreateSphere =
        (delegate* unmanaged[Cdecl]<nint, double, nint>)Library.Find("dCreateSphere");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, double, nint> CreatePlane =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, double, nint>)Library.Find("dCreatePlane");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, double, double, void> GeomSetPosition =
        (delegate* unmanaged[Cdecl]<nint, double, double, double, void>)Library.Find("dGeomSetPosition");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, void> GeomSetBody =
        (delegate* unmanaged[Cdecl]<nint, nint, void>)Library.Find("dGeomSetBody");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> GeomGetBody = (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("dGeomGetBody");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, void> GeomSetData =
        (delegate* unmanaged[Cdecl]<nint, nint, void>)Library.Find("dGeomSetData");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> GeomGetData = (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("dGeomGetData");
    internal static readonly delegate* unmanaged[Cdecl]<int, nint> JointGroupCreate = (delegate* unmanaged[Cdecl]<int, nint>)Library.Find("dJointGroupCreate");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> JointGroupEmpty = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("dJointGroupEmpty");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> JointGroupDestroy =
        (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("dJointGroupDestroy");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, Contact*, nint> JointCreateContact =
        (delegate* unmanaged[Cdecl]<nint, nint, Contact*, nint>)Library.Find("dJointCreateContact");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, nint, void> JointAttach =
        (delegate* unmanaged[Cdecl]<nint, nint, nint, void>)Library.Find("dJointAttach");

    /// <summary>dContactBounce.</summary>
    internal const int ContactBounce = 4;

    /// <summary>
    /// dContactApprox1: friction is proportional to the normal force, as a pyramid about Coulomb's cone, and no fixed force.
    /// </summary>
    internal const int ContactApprox1 = 0x7000;

    private static readonly delegate* unmanaged[Cdecl]<uint, int> Init = (delegate* unmanaged[Cdecl]<uint, int>)Library.Find("dInitODE2");
    private static readonly delegate* unmanaged[Cdecl]<uint, int> AllocateForThread =
        (delegate* unmanaged[Cdecl]<uint, int>)Library.Find("dAllocateODEDataForThread");
    private static readonly delegate* unmanaged[Cdecl]<nuint, void> RandSetSeed =
        (delegate* unmanaged[Cdecl]<nuint, void>)Library.Find("dRandSetSeed");
    private static readonly delegate* unmanaged[Cdecl]<delegate* unmanaged[Cdecl]<int, byte*, nint, void>, void> SetMessageHandler =
        (delegate* unmanaged[Cdecl]<delegate* unmanaged[Cdecl]<int, byte*, nint, void>, void>)Library.Find("dSetMessageHandler");
    private static readonly delegate* unmanaged[Cdecl]<byte*> GetConfiguration = (delegate* unmanaged[Cdecl]<byte*>)Library.Find("dGetConfiguration");

    /// <summary>The reason why it cannot be used; null if it can.</summary>
    internal static string? Missing { get; } = Check();

    /// <summary>
    /// Prepares a run: resets the random numbers, so that every run of a scene is the same, and silences messages on stderr.
    /// </summary>
    internal static void Begin()
    {
        RandSetSeed(0);
        SetMessageHandler(&Ignore);
    }

    /// <summary>Allocates ODE's data of this thread. Each thread that steps worlds needs its own.</summary>
    internal static void UseThread() => AllocateForThread(uint.MaxValue);

    [UnmanagedCallersOnly(CallConvs = [typeof(CallConvCdecl)])]
    private static void Ignore(int number, byte* message, nint arguments)
    {
    }

    private static string? Check()
    {
        if (!Library.IsThere)
        {
            return "ODE is not there: apt-get install libode8 (Debian), or libode from ode.org";
        }

        string configuration = Marshal.PtrToStringUTF8((nint)GetConfiguration()) ?? "";
        return !configuration.Contains("ODE_double_precision", StringComparison.Ordinal) ? "ODE is there in single precision, and double is needed"
            : Init(0) == 0 ? "ODE is there and does not start"
            : null;
    }

    /// <summary>dMass: the mass, its centre, its inertia.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct Mass
    {
        internal double Kilograms;
        internal fixed double Rest[16];
    }

    /// <summary>dContactGeom.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct ContactGeom
    {
        internal fixed double Position[4];
        internal fixed double Normal[4];
        internal double Depth;
        internal nint First;
        internal nint Second;
        internal int FirstSide;
        internal int SecondSide;
    }

    /// <summary>dContact: dSurfaceParameters, dContactGeom, the first direction of friction.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct Contact
    {
        internal int Mode;
        internal double Friction;
        internal double SecondFriction;
        internal fixed double Rolling[3];
        internal double Bounce;
        internal double BounceVelocity;
        internal fixed double Soft[2];
        internal fixed double Motion[3];
        internal fixed double Slip[2];
        internal ContactGeom Geom;
        internal fixed double Direction[4];
    }
}
