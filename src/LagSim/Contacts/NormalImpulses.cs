using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// The impulses along the normals of contacts: of few exactly (<see cref="ActiveSet"/>), of many by <see cref="ProjectedGradients"/>.
/// </summary>
/// <remarks>Deterministic: contacts come in canonical order. Not thread-safe. Cost: that of the solver it takes.</remarks>
internal sealed class NormalImpulses
{
    /// <summary>The largest number of contacts that are solved exactly: beyond it the cost grows too fast for one event.</summary>
    internal const int MaxAtOnce = 96;

    /// <summary>
    /// The number of contacts that are always solved exactly. More are only if masses differ by more than <see cref="LikeMasses"/>;
    /// otherwise gradients get as near in less time.
    /// </summary>
    internal const int FewAtOnce = 32;

    /// <summary>By what factor masses may differ for <see cref="ProjectedGradients"/> to get to the rounding in its steps.</summary>
    internal const double LikeMasses = 1000;

    /// <summary>
    /// The number of bodies at which a contact that is solved exactly costs as much as a sweep. Measured: 66 contacts of 36 bodies take 740
    /// µs, and count as 650.
    /// </summary>
    private const int BodiesAStep = 8;

    private readonly ActiveSet few = new();
    private readonly ProjectedGradients many = new();

    /// <summary>The cost of the last solution, in sweeps over all its contacts.</summary>
    internal int Steps { get; private set; }

    /// <summary>Solves; false if some demand cannot be met, or was not. Leaves the impulses, and the change of every velocity.</summary>
    /// <param name="contacts">With their normals.</param>
    /// <param name="masses">By number of body, in kg; a held one has an infinite mass.</param>
    /// <param name="demand">By contact: by how much faster it is to open, at least.</param>
    /// <param name="impulse">By contact: is set.</param>
    /// <param name="change">By body: is set.</param>
    /// <param name="again">Whether many begin with the contacts' impulses as they are, not with none.</param>
    /// <param name="enough">The shortfall, in m/s, at which a demand of many contacts counts as met.</param>
    internal bool TrySolve(
        Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<double> impulse, Span<Vector3D> change,
        bool again = false, double enough = 0)
    {
        if (!AreMany(contacts.Length, masses))
        {
            Steps = contacts.Length * (1 + (masses.Length / BodiesAStep));
            return few.TrySolve(contacts, masses, demand, impulse, change);
        }

        bool isMet = many.TrySolve(contacts, masses, demand, impulse, change, again, enough);
        Steps = many.Steps;
        return isMet;
    }

    /// <summary>Whether so many contacts, between such masses, are left to <see cref="ProjectedGradients"/>.</summary>
    private static bool AreMany(int count, Span<double> masses)
    {
        if (count <= FewAtOnce || count > MaxAtOnce)
        {
            return count > MaxAtOnce;
        }

        double least = double.PositiveInfinity;
        double most = 0;
        for (int b = 0; b < masses.Length; b++)
        {
            least = Math.Min(least, masses[b]);
            most = Math.Max(most, masses[b]); // infinite with a hand, which may ask for what cannot be met
        }

        return most <= LikeMasses * least;
    }
}
