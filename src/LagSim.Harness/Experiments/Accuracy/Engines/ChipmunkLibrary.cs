using System;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// The parts of Chipmunk's C interface in use (chipmunk/chipmunk.h of version 7). Its numbers are doubles on 64-bit systems.
/// </summary>
internal static unsafe class ChipmunkLibrary
{
    private static readonly NativeFunctions Library = new("libchipmunk.so.7", "libchipmunk.so", "libchipmunk.7.dylib", "libchipmunk.dylib", "chipmunk.dll");

    internal static readonly delegate* unmanaged[Cdecl]<nint> SpaceNew = (delegate* unmanaged[Cdecl]<nint>)Library.Find("cpSpaceNew");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> SpaceFree = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("cpSpaceFree");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, void> SpaceSetGravity =
        (delegate* unmanaged[Cdecl]<nint, Vect, void>)Library.Find("cpSpaceSetGravity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> SpaceGetStaticBody =
        (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("cpSpaceGetStaticBody");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, nint> SpaceAddBody =
        (delegate* unmanaged[Cdecl]<nint, nint, nint>)Library.Find("cpSpaceAddBody");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, nint> SpaceAddShape =
        (delegate* unmanaged[Cdecl]<nint, nint, nint>)Library.Find("cpSpaceAddShape");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, void> SpaceStep =
        (delegate* unmanaged[Cdecl]<nint, double, void>)Library.Find("cpSpaceStep");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, void> SpaceRemoveShape =
        (delegate* unmanaged[Cdecl]<nint, nint, void>)Library.Find("cpSpaceRemoveShape");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, void> SpaceRemoveBody =
        (delegate* unmanaged[Cdecl]<nint, nint, void>)Library.Find("cpSpaceRemoveBody");
    internal static readonly delegate* unmanaged[Cdecl]<double, double, nint> BodyNew =
        (delegate* unmanaged[Cdecl]<double, double, nint>)Library.Find("cpBodyNew");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> BodyFree = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("cpBodyFree");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, void> BodySetPosition =
        (delegate* unmanaged[Cdecl]<nint, Vect, void>)Library.Find("cpBodySetPosition");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, void> BodySetVelocity =
        (delegate* unmanaged[Cdecl]<nint, Vect, void>)Library.Find("cpBodySetVelocity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, void> BodySetForce =
        (delegate* unmanaged[Cdecl]<nint, Vect, void>)Library.Find("cpBodySetForce");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint, void> BodySetUserData =
        (delegate* unmanaged[Cdecl]<nint, nint, void>)Library.Find("cpBodySetUserData");
    internal static readonly delegate* unmanaged[Cdecl]<nint, nint> BodyGetUserData = (delegate* unmanaged[Cdecl]<nint, nint>)Library.Find("cpBodyGetUserData");
    internal static readonly delegate* unmanaged[Cdecl]<nint, delegate* unmanaged[Cdecl]<nint, Vect, double, double, void>, void> BodySetVelocityUpdateFunc =
        (delegate* unmanaged[Cdecl]<nint, delegate* unmanaged[Cdecl]<nint, Vect, double, double, void>, void>)Library.Find("cpBodySetVelocityUpdateFunc");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, double, double, void> BodyUpdateVelocity =
        (delegate* unmanaged[Cdecl]<nint, Vect, double, double, void>)Library.Find("cpBodyUpdateVelocity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect> BodyGetPosition = (delegate* unmanaged[Cdecl]<nint, Vect>)Library.Find("cpBodyGetPosition");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect> BodyGetVelocity = (delegate* unmanaged[Cdecl]<nint, Vect>)Library.Find("cpBodyGetVelocity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, Vect, nint> CircleShapeNew =
        (delegate* unmanaged[Cdecl]<nint, double, Vect, nint>)Library.Find("cpCircleShapeNew");
    internal static readonly delegate* unmanaged[Cdecl]<nint, Vect, Vect, double, nint> SegmentShapeNew =
        (delegate* unmanaged[Cdecl]<nint, Vect, Vect, double, nint>)Library.Find("cpSegmentShapeNew");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, void> ShapeSetElasticity =
        (delegate* unmanaged[Cdecl]<nint, double, void>)Library.Find("cpShapeSetElasticity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, void> ShapeSetFriction =
        (delegate* unmanaged[Cdecl]<nint, double, void>)Library.Find("cpShapeSetFriction");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double, void> SpaceSetCollisionSlop =
        (delegate* unmanaged[Cdecl]<nint, double, void>)Library.Find("cpSpaceSetCollisionSlop");
    internal static readonly delegate* unmanaged[Cdecl]<nint, double> BodyGetAngularVelocity =
        (delegate* unmanaged[Cdecl]<nint, double>)Library.Find("cpBodyGetAngularVelocity");
    internal static readonly delegate* unmanaged[Cdecl]<nint, void> ShapeFree = (delegate* unmanaged[Cdecl]<nint, void>)Library.Find("cpShapeFree");

    /// <summary>The reason why it cannot be used; null if it can.</summary>
    internal static string? Missing { get; } =
        !Library.IsThere ? "Chipmunk is not there: apt-get install libchipmunk7 (Debian)"
        : !Environment.Is64BitProcess ? "Chipmunk is there in single precision, as on all 32-bit systems, and double is needed"
        : null;

    /// <summary>
    /// A build with assertions, such as Debian's, prints a notice to stdout when it makes its first space, where only results belong.
    /// </summary>
    internal static void Begin() => Greeting.Value.ToString();

    private static readonly Lazy<bool> Greeting = new(() =>
    {
        using NativeSilence silence = new();
        SpaceFree(SpaceNew());
        return true;
    });

    /// <summary>cpVect.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal readonly struct Vect(double x, double y)
    {
        internal readonly double X = x;
        internal readonly double Y = y;
    }
}
