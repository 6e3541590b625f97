using LagSim.Scenes;

namespace LagSim.Contacts;

/// <content>Where the bodies of a step are, and how far what touches is apart.</content>
internal sealed partial class IslandStep
{
    private double Reach(in Touch t) =>
        radii[t.First] + (t.Second == ContactPoint.Static ? scene.SphereArray[t.Surface - scene.PlaneArray.Length].Radius : radii[t.Second]);

    private double Gap(in Touch t, bool atEnd) => Gap(t, Place(t.First, atEnd), t.Second == ContactPoint.Static ? Vector3D.Zero : Place(t.Second, atEnd));

    /// <summary>The gap on the way, where that part of the step is over.</summary>
    private double Gap(in Touch t, double part) => Gap(t, Place(t.First, part), t.Second == ContactPoint.Static ? Vector3D.Zero : Place(t.Second, part));

    private double Gap(in Touch t, in Vector3D at, in Vector3D other)
    {
        if (t.Second != ContactPoint.Static)
        {
            return (at - other).Length - Reach(t);
        }

        return t.Surface < scene.PlaneArray.Length
            ? scene.PlaneArray[t.Surface].Gap(at, radii[t.First])
            : (at - scene.SphereArray[t.Surface - scene.PlaneArray.Length].Centre).Length - Reach(t);
    }

    private Vector3D Normal(in Touch t, bool atEnd)
    {
        if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
        {
            return scene.PlaneArray[t.Surface].Normal;
        }

        Vector3D apart = Place(t.First, atEnd)
            - (t.Second == ContactPoint.Static ? scene.SphereArray[t.Surface - scene.PlaneArray.Length].Centre : Place(t.Second, atEnd));
        double length = apart.Length;
        return length > 0 ? apart / length : Vector3D.Up;
    }

    private Vector3D Place(int body, bool atEnd) => atEnd ? members[body].End : members[body].Start;

    /// <summary>On the cubic with the positions and velocities of both ends.</summary>
    private Vector3D Place(int body, double part)
    {
        ref readonly Member m = ref members[body];
        double left = 1 - part;
        Vector3D way = (m.Middle * (part * part * (3 - (2 * part)))) + (((m.Velocity * left) - (m.EndVelocity * part)) * (part * left));
        return m.Start + (way * Length.ToSeconds());
    }
}
