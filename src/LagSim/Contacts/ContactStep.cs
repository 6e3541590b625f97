using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// One step of an island: from its bodies' places and velocities to the velocities for the next step of the common clock.
/// </summary>
/// <remarks>
/// <para>Leapfrog: velocities are those of the middle of a step, and a body moves on the chord that they give. At a tick they get the
/// impulses of the forces in a whole step and those of the contacts. So bodies that fall, slide or roll under constant forces are exact at
/// the ticks, but for rounding.</para>
/// <para>Contacts are solved at the velocity level (see <see cref="ContactSolver"/>), including those that might close within the step: a
/// gap may be used up and no more. Since spheres are convex, chords that obey this on the line between two centres obey it
/// everywhere.</para>
/// <para>A pure function of its inputs. Order counts: bodies come in canonical order, and contacts are found in it. Cost: the pairs that
/// are near along one axis, and the contacts times the sweeps.</para>
/// </remarks>
internal sealed class ContactStep
{
    /// <summary>
    /// The largest number of sweeps. Then <see cref="NormalRefinement"/> solves the normals. What is left of friction is an error but no
    /// fault: the next step continues from the impulses that the sweeps reached.
    /// </summary>
    internal const int MaxSweeps = 200;

    private NormalRefinement? normals; // made when a step needs it, as the next
    private EnergyLimit? limit;
    private readonly StepContacts contacts;
    private bool hasDeep; // whether something is deeper in something than the tolerance, and to be pushed out as such
    private Motion[] free = Array.Empty<Motion>(); // by body

    internal ContactStep(Scene scene, ContactScale scale, SolverRules? rules = null)
    {
        Scale = scale;
        Rules = rules ?? SolverRules.Usual;
        contacts = new StepContacts(scene.Surfaces, scale, Problem, Rules.LimitsCrowds);
    }

    /// <summary>The bodies and contacts of the step, with the velocities of its middle once it is solved.</summary>
    internal ContactProblem Problem { get; } = new();

    internal ContactScale Scale { get; }

    /// <summary>The rules for its solutions, and for those of impacts on islands.</summary>
    internal SolverRules Rules { get; }

    /// <summary>How many sweeps the last took, and steps of <see cref="NormalRefinement"/>, which cost as much.</summary>
    internal int Sweeps { get; private set; }

    /// <summary>
    /// Whether the last solution is one: its sweeps settled, or its normals were solved instead and nothing rubs in it. Else friction and
    /// rolling resistance are as far as the sweeps got.
    /// </summary>
    internal bool HasSettled { get; private set; }

    /// <summary>Begins again, with no body.</summary>
    internal void Clear() => Problem.Clear();

    /// <summary>Adds a body of the island.</summary>
    /// <param name="spec">The body's spec.</param>
    /// <param name="position">Where it is at the tick.</param>
    /// <param name="velocity">Its velocity so far: that of the middle of the step before.</param>
    /// <param name="gain">The velocity that forces add until the middle of this step; zero for a held body, whose velocity is its mean in
    /// the step.</param>
    /// <param name="spin">Its spin.</param>
    /// <param name="isHeld">Whether it is held.</param>
    /// <param name="pull">How hard forces pull it, in m/s².</param>
    /// <param name="filter">What it collides with.</param>
    internal void AddBody(
        in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D gain, in Vector3D spin, bool isHeld, double pull = 0,
        CollisionFilter filter = default)
    {
        int n = Problem.AddBody(isHeld ? double.PositiveInfinity : spec.Mass, spec.Radius, velocity + gain, spin);
        if (n == free.Length)
        {
            Array.Resize(ref free, Problem.Bodies.Length);
        }

        free[n] = new Motion { Velocity = velocity + gain, Spin = spin };
        contacts.SetBody(n, spec, position, pull, filter);
    }

    /// <summary>Finds what touches, or might within the step, among the bodies and with static surfaces.</summary>
    internal void FindContacts(double seconds) => contacts.Find(seconds);

    /// <summary>Leaves out contacts that did not hold before and are left to impacts; see <see cref="StepContacts.DropImpacts"/>.</summary>
    internal void DropImpacts(double seconds) => contacts.DropImpacts(seconds);

    /// <summary>Whether a body might strike another of the island within the step.</summary>
    internal bool MayMeet(int body) => contacts.MayMeet(body);

    /// <summary>Solves the step from the impulses that its contacts have.</summary>
    internal void Solve(double seconds, double tolerance)
    {
        hasDeep = false;
        bool isFree = !Problem.HasHand(); // what is deep beside a hand is pushed out as such when the hand lets go
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            bool isDeep = -c.Gap > Scale.Length && isFree;
            c.Target = c.Gap >= 0 ? -c.Gap / seconds : Math.Min(-c.Gap / seconds, Scale.Pull * seconds);
            if (isDeep)
            {
                c.Target = Scale.DeepSpeed(-c.Gap, seconds);
                Brake(c, 2 * Scale.Pull * seconds);
                Deepen(c.First, c.Target);
                Deepen(c.Second, c.Target);
                hasDeep = true;
            }
        }

        if (Rules.LimitsHands)
        {
            ContactSolver.LimitHands(Problem, Scale.Pull * seconds);
        }

        Sweeps = 0;
        Sweep(tolerance);
    }

    /// <summary>
    /// Slows two down that are deep in each other and part faster than they are pushed apart, by no more than that speed falls in a step:
    /// twice what the pull gives in it. So what leaves keeps little of it, and what flies through is hardly held back.
    /// </summary>
    private void Brake(in SolverContact c, double most)
    {
        double excess = ContactSolver.Opening(Problem, c) - c.Target;
        if (excess > 0)
        {
            Vector3D push = c.Normal * (-Math.Min(excess, most) * c.NormalMass);
            Brake(c.First, push);
            if (c.Second != ContactPoint.Static)
            {
                Brake(c.Second, -push);
            }
        }
    }

    /// <summary>Notes that a deep contact pushes a body out so fast.</summary>
    private void Deepen(int body, double speed)
    {
        if (body != ContactPoint.Static)
        {
            free[body].PushedOut = Math.Max(free[body].PushedOut, speed);
        }
    }

    /// <summary>By how much a body was slowed down because it parts too fast from what it is deep in, in m/s.</summary>
    internal Vector3D Braked(int body) => free[body].Braked;

    private void Brake(int body, in Vector3D push)
    {
        Vector3D change = push * Problem.Bodies[body].InverseMass;
        Problem.Bodies[body].Velocity += change;
        free[body].Velocity += change;
        free[body].Braked += change;
    }

    /// <summary>
    /// Limits the energy of a step to what its bodies came with, including what forces give in it, or to what the pull gives them from
    /// rest. Each contact pushes its overlap out no faster than a fall of a step, but in a stack these speeds add up and would throw its
    /// top into the air. So the result moves from a solution that pushes nothing out towards the one that does only as far as there is
    /// energy for.
    /// </summary>
    internal void LimitEnergy(double seconds, double tolerance)
    {
        bool hasHand = Problem.HasHand();
        if (hasHand && ContactSolver.ShareHands(Problem))
        {
            SolveAgain(tolerance);
        }

        double most = Problem.EnergyAt(Scale.Pull * seconds);
        double came = 0;
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            ref readonly SolverBody body = ref Problem.Bodies[b];
            came += body.InverseMass > 0 ? ContactProblem.EnergyOf(body, free[b].Velocity, free[b].Spin) : 0;
        }

        most = (hasHand ? most + came : Math.Max(most, came)) + (hasDeep ? DeepEnergy() : 0);
        if (!Rules.LimitsEnergy || (hasHand && !Rules.BoundsHands) || !Problem.Gains(most))
        {
            return;
        }

        limit ??= new EnergyLimit();
        limit.Remember(Problem);
        Problem.DropRebounds();
        SolveAgain(tolerance);
        if (Problem.Gains(most))
        {
            Problem.DropFriction();
            SolveAgain(tolerance);
        }

        limit.GoTowards(Problem, most);
    }

    /// <summary>
    /// What pushing out may add to the kinetic energy, in J: that of all bodies that are deep at the speeds at which their deepest contacts
    /// push them out, less what they have already, seen from their centre of mass. So what flies along together parts too, and what parts
    /// as fast as that gains no more.
    /// </summary>
    private double DeepEnergy()
    {
        Vector3D common = Vector3D.Zero;
        double mass = 0;
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            if (free[b].PushedOut > 0 && Problem.Bodies[b].InverseMass > 0)
            {
                mass += 1 / Problem.Bodies[b].InverseMass;
                common += (free[b].Velocity - common) * (1 / (Problem.Bodies[b].InverseMass * mass));
            }
        }

        double missing = 0;
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            if (free[b].PushedOut > 0 && Problem.Bodies[b].InverseMass > 0)
            {
                missing += 0.5 * ((free[b].PushedOut * free[b].PushedOut) - (free[b].Velocity - common).LengthSquared) / Problem.Bodies[b].InverseMass;
            }
        }

        return Math.Max(0, missing);
    }

    /// <summary>
    /// Which contacts hold in the step that was solved: those that push, and those that held before and open by less than a quarter of the
    /// tolerance, as along what is round, where a chord leads away a little and comes back.
    /// </summary>
    internal void FindHolding(double seconds)
    {
        contacts.FindMeetings(seconds);
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Holds = c.Impulse > 0 || (c.Held && !c.IsElastic && c.Gap + (ContactSolver.Opening(Problem, c) * seconds) <= 0.25 * Scale.Length);
        }
    }

    /// <summary>Has a body come with another velocity, forces included: then the step is to be solved again.</summary>
    internal void Regain(int body, in Vector3D velocity, in Vector3D spin)
    {
        free[body].Velocity = velocity + free[body].Braked;
        free[body].Spin = spin;
    }

    /// <summary>Solves the step again from the impulses that it has.</summary>
    internal void SolveAgain(double tolerance)
    {
        BeginAnew();
        Sweep(tolerance);
    }

    /// <summary>Has a body come from rest, with what forces give it in a step, until it is taken from rest.</summary>
    internal void PutToRest(int body, in Vector3D gain)
    {
        ref Motion came = ref free[body];
        (came.BeforeRest, came.SpinBeforeRest) = (came.Velocity, came.Spin);
        (came.Velocity, came.Spin) = (gain, Vector3D.Zero);
    }

    /// <summary>Has all bodies come as before they were put to rest.</summary>
    internal void TakeFromRest()
    {
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            (free[b].Velocity, free[b].Spin) = (free[b].BeforeRest, free[b].SpinBeforeRest);
        }

        BeginAnew();
    }

    /// <summary>Solves a step of bodies that were put to rest: what holds is closed, and nothing is pushed out.</summary>
    internal void SolveAtRest(double seconds, double tolerance)
    {
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Target = c.Held ? 0 : Math.Min(0, -c.Gap / seconds);
        }

        Sweeps = 0;
        SolveAgain(tolerance);
    }

    /// <summary>Whether something is deeper in something than the tolerance.</summary>
    internal bool IsDeep()
    {
        bool isDeep = false;
        for (int i = 0; i < Problem.ContactCount && !isDeep; i++)
        {
            isDeep = -Problem.Contacts[i].Gap > Scale.Length;
        }

        return isDeep;
    }

    private void BeginAnew()
    {
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            Problem.Bodies[b].Velocity = free[b].Velocity;
            Problem.Bodies[b].Spin = free[b].Spin;
        }
    }

    /// <summary>
    /// Sweeps from the impulses of the last step. If they are too large to add up, the normals are solved first, from none. If sweeps do
    /// not converge, they are solved last.
    /// </summary>
    private void Sweep(double tolerance)
    {
        if (Problem.HasHand() || ContactSolver.CanAddUp(Problem, tolerance))
        {
            ContactSolver.ApplyGiven(Problem);
        }
        else
        {
            Problem.DropImpulses();
            Sweeps += SolveNormals(tolerance);
        }

        int sweeps = ContactSolver.Solve(Problem, tolerance, MaxSweeps);
        HasSettled = sweeps < MaxSweeps;
        Sweeps += sweeps;
        if (Rules.RefinesNormals && !Problem.IsCrowd(Scale.Length) && NormalRefinement.IsNeeded(Problem, sweeps, tolerance))
        {
            BeginAnew();
            Sweeps += SolveNormals(tolerance);
            HasSettled = !Problem.Rubs();
        }
    }

    private int SolveNormals(double tolerance)
    {
        normals ??= new NormalRefinement();
        return normals.Solve(Problem, tolerance);
    }

    /// <summary>A velocity and a spin without contacts.</summary>
    private struct Motion
    {
        internal Vector3D Braked; // part of the velocity
        internal Vector3D BeforeRest; // the velocity that it came with, as long as it is put to rest, and the spin
        internal Vector3D SpinBeforeRest;
        internal double PushedOut; // in m/s: by its deepest contact, if that is deeper than the tolerance
        internal Vector3D Velocity;
        internal Vector3D Spin;
    }
}
