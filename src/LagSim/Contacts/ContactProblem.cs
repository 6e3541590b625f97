using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>The bodies and contacts of one impact or contact step, numbered within it: what <see cref="ContactSolver"/> works on.</summary>
/// <remarks>Allocates only when there are more bodies or contacts than ever before. Not thread-safe.</remarks>
internal sealed class ContactProblem
{
    /// <summary>The moment of inertia of a solid sphere, in m r².</summary>
    internal const double SphereInertia = 1 / ImpactFriction.TurnPerImpulse;

    internal SolverBody[] Bodies = Array.Empty<SolverBody>();
    internal SolverContact[] Contacts = Array.Empty<SolverContact>();

    internal int BodyCount { get; private set; }

    internal int ContactCount { get; private set; }

    /// <summary>Begins again, with no body.</summary>
    internal void Clear()
    {
        BodyCount = 0;
        ContactCount = 0;
    }

    /// <summary>Adds a body; a held one has an infinite mass.</summary>
    /// <returns>Its number.</returns>
    internal int AddBody(double mass, double radius, in Vector3D velocity, in Vector3D spin)
    {
        if (BodyCount == Bodies.Length)
        {
            Array.Resize(ref Bodies, Math.Max(1, 2 * BodyCount));
        }

        if (double.IsPositiveInfinity(mass))
        {
            Array.Resize(ref handRooms, Math.Max(handRooms.Length, Bodies.Length));
            handRooms[BodyCount] = mass;
        }

        Bodies[BodyCount] = new SolverBody { Velocity = velocity, Spin = spin, InverseMass = ImpactSolver.Inverse(mass), Radius = radius };
        return BodyCount++;
    }

    /// <summary>Adds a contact without impulses.</summary>
    /// <param name="first">The number of a body.</param>
    /// <param name="second">The other, or <see cref="ContactPoint.Static"/>.</param>
    /// <param name="surface">Which static surface; -1 between two bodies.</param>
    /// <param name="normal">From the second to the first.</param>
    /// <param name="gap">How far apart the two are, in metres.</param>
    /// <param name="friction">The coefficient of friction.</param>
    /// <param name="lever">The lever of rolling resistance, in metres.</param>
    /// <returns>The contact, to be filled in; valid until the next is added.</returns>
    internal ref SolverContact AddContact(int first, int second, int surface, in Vector3D normal, double gap, double friction, double lever)
    {
        if (ContactCount == Contacts.Length)
        {
            Array.Resize(ref Contacts, Math.Max(1, 2 * ContactCount));
        }

        ref readonly SolverBody a = ref Bodies[first];
        double inverse = a.InverseMass;
        double turning = a.InverseMass / (a.Radius * a.Radius);
        if (second != ContactPoint.Static)
        {
            ref readonly SolverBody b = ref Bodies[second];
            inverse += b.InverseMass;
            turning += b.InverseMass / (b.Radius * b.Radius);
        }

        ref SolverContact c = ref Contacts[ContactCount++];
        c = new SolverContact
        {
            First = first,
            Second = second,
            Surface = surface,
            Normal = normal,
            Gap = gap,
            Friction = friction,
            Lever = lever,
            Most = double.PositiveInfinity,
            NormalInverse = inverse,
            NormalMass = inverse > 0 ? 1 / inverse : 0,
            FrictionMass = inverse > 0 ? 1 / (ImpactFriction.SlipPerImpulse * inverse) : 0,
            Follows = friction * friction <= 0.5 ? 1 : 1 / (1 + (friction * friction)),
            TurnMass = turning > 0 ? 1 / (ImpactFriction.TurnPerImpulse * turning) : 0,
        };
        return ref c;
    }

    /// <summary>
    /// The largest impulse that a held body may give in all its contacts together, friction included, in N s. Infinite until it is set.
    /// </summary>
    internal ref double HandRoom(int body) => ref handRooms[body];

    private double[] handRooms = Array.Empty<double>(); // by body, of held ones

    /// <summary>Whether a contact is with a held body, and which that is.</summary>
    internal bool IsByHand(in SolverContact c, out int hand)
    {
        hand = Bodies[c.First].InverseMass == 0 ? c.First : c.Second;
        return hand >= 0 && Bodies[hand].InverseMass == 0;
    }

    /// <summary>The work that hands do on the bodies that they touch, in J: what they push times how far they go.</summary>
    internal double HandWork()
    {
        double sum = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly SolverContact c = ref Contacts[i];
            if (IsByHand(c, out int hand))
            {
                Vector3D push = (c.Normal * c.Impulse) + c.FrictionImpulse; // on the first
                sum += Vector3D.Dot(hand == c.First ? -push : push, Bodies[hand].Velocity);
            }
        }

        return sum;
    }

    /// <summary>No contact has impulses, need open, or rubs: a solution of this makes no energy, even where sweeps do not settle.</summary>
    internal void DropFriction()
    {
        DropRebounds();
        for (int i = 0; i < ContactCount; i++)
        {
            (Contacts[i].Friction, Contacts[i].Lever) = (0, 0);
        }
    }

    /// <summary>No contact has impulses any more, nor need it open.</summary>
    internal void DropRebounds()
    {
        DropImpulses();
        for (int i = 0; i < ContactCount; i++)
        {
            Contacts[i].Target = Math.Min(0, Contacts[i].Target);
        }
    }

    /// <summary>No contact has impulses any more.</summary>
    internal void DropImpulses()
    {
        for (int i = 0; i < ContactCount; i++)
        {
            Contacts[i].DropImpulses();
        }
    }

    /// <summary>
    /// Whether bodies lie inside one another: as many pairs are deeper in each other than so many metres as there are bodies. They are to
    /// be parted,
    /// not balanced, so what sweeps leave is up to the next step.
    /// </summary>
    internal bool IsCrowd(double depth)
    {
        int deep = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly SolverContact c = ref Contacts[i];
            deep += c.Second >= 0 && c.Gap < -depth ? 1 : 0;
        }

        return deep > 0 && deep >= BodyCount;
    }

    /// <summary>Keeps the first contacts alone.</summary>
    internal void Keep(int count) => ContactCount = count;

    /// <summary>Lists the contacts of each body: ascending, so in canonical order if they are.</summary>
    internal void List()
    {
        lists.Clear(BodyCount, ContactCount);
        for (int i = 0; i < ContactCount; i++)
        {
            lists.Count(Contacts[i].First, Contacts[i].Second);
        }

        lists.Sum();
        for (int i = ContactCount - 1; i >= 0; i--)
        {
            lists.Put(i, Contacts[i].First, Contacts[i].Second);
        }
    }

    /// <summary>The contacts of a body, by number, as they were listed last.</summary>
    internal Span<int> ListOf(int body) => lists.Of(body);

    private readonly ContactLists lists = new();

    /// <summary>Whether one of its contacts has friction.</summary>
    internal bool Rubs()
    {
        bool rubs = false;
        for (int i = 0; i < ContactCount && !rubs; i++)
        {
            rubs = Contacts[i].Friction > 0;
        }

        return rubs;
    }

    /// <summary>Whether one of its bodies is held, since a hand gives and takes energy.</summary>
    internal bool HasHand()
    {
        bool has = false;
        for (int b = 0; b < BodyCount && !has; b++)
        {
            has = Bodies[b].InverseMass == 0;
        }

        return has;
    }

    /// <summary>The kinetic energy of all, but of those in hands, if each were so fast and turned not; in J.</summary>
    internal double EnergyAt(double speed)
    {
        double sum = 0;
        for (int b = 0; b < BodyCount; b++)
        {
            sum += Bodies[b].InverseMass > 0 ? 0.5 * speed * speed / Bodies[b].InverseMass : 0;
        }

        return sum;
    }

    /// <summary>By which part energy may have grown by rounding, of a sum over thousands of bodies.</summary>
    private const double GainByRounding = 1e-9;

    /// <summary>Whether the bodies have more energy than so much and the work of hands, in J, by more than rounding.</summary>
    internal bool Gains(double most) => !(KineticEnergy() - HandWork() <= most * (1 + GainByRounding)); // also if it is not a number

    /// <summary>The kinetic energy of a body that is not held, at this velocity and spin; in J.</summary>
    internal static double EnergyOf(in SolverBody body, in Vector3D velocity, in Vector3D spin) =>
        0.5 * (velocity.LengthSquared + (SphereInertia * body.Radius * body.Radius * spin.LengthSquared)) / body.InverseMass;

    /// <summary>The kinetic energy of all, spin included, but of those in hands; in J.</summary>
    internal double KineticEnergy()
    {
        double sum = 0;
        for (int b = 0; b < BodyCount; b++)
        {
            ref readonly SolverBody body = ref Bodies[b];
            if (body.InverseMass > 0)
            {
                sum += EnergyOf(body, body.Velocity, body.Spin);
            }
        }

        return sum;
    }
}

/// <summary>One body of a <see cref="ContactProblem"/>.</summary>
internal struct SolverBody
{
    internal Vector3D Velocity;
    internal Vector3D Spin;
    internal double InverseMass; // 0 for a held body
    internal double Radius;
    internal double Changed; // by the visits of its contacts, in m/s, all added up
}

/// <summary>
/// One contact of a <see cref="ContactProblem"/>: what is asked of it, and the impulses that do it, on the first of the two.
/// </summary>
internal struct SolverContact
{
    internal int First;
    internal int Second;
    internal int Surface;
    internal Vector3D Normal;
    internal double Gap;
    internal double Target; // the least opening, in m/s
    internal double Friction;
    internal double Lever;
    internal double Follows; // which part of the way the bound of friction follows the normal impulse in a visit
    internal double Bound; // of friction, in N s, where it follows in parts
    internal double Most; // the largest impulse along the normal
    internal double NormalInverse;
    internal double NormalMass;
    internal double FrictionMass;
    internal double TurnMass;
    internal bool IsElastic; // loses no energy, and is of a step only if it held before
    internal bool Held; // whether the contact held before the step
    internal bool Holds; // and whether it holds in it
    internal double Impulse; // along the normal, in N s
    internal Vector3D FrictionImpulse; // of friction
    internal bool HasFrictionImpulse;
    internal double Seen; // what of its bodies' changes it has seen
    internal Vector3D Turn; // of rolling resistance, in N m s

    /// <summary>It has no impulses any more.</summary>
    internal void DropImpulses() => (Impulse, FrictionImpulse, Turn, HasFrictionImpulse, Bound) = (0, Vector3D.Zero, Vector3D.Zero, false, 0);
}
