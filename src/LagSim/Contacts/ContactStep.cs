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
    private readonly DeepestContacts deepest;
    private Motion[] free = Array.Empty<Motion>(); // by body

    internal ContactStep(Scene scene, ContactScale scale, SolverRules? rules = null)
    {
        Scale = scale;
        Rules = rules ?? SolverRules.Usual;
        contacts = new StepContacts(scene.Surfaces, scale, Problem);
        deepest = new DeepestContacts(Problem);
    }

    /// <summary>The bodies and contacts of the step, with the velocities of its middle once it is solved.</summary>
    internal ContactProblem Problem { get; } = new();

    internal ContactScale Scale { get; }

    /// <summary>The rules for its solutions, and for those of impacts on islands.</summary>
    internal SolverRules Rules { get; }

    /// <summary>How many sweeps the last took, and steps of <see cref="NormalRefinement"/>, which cost as much.</summary>
    internal int Sweeps { get; private set; }

    /// <summary>Begins again, with no body.</summary>
    internal void Clear()
    {
        Problem.Clear();
        deepest.Clear();
    }

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
        if (Rules.LimitsCrowds)
        {
            deepest.LeaveOut();
        }

        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Target = c.Gap >= 0 ? -c.Gap / seconds : Math.Min(-c.Gap / seconds, Scale.Pull * seconds);
        }

        if (Rules.LimitsHands)
        {
            ContactSolver.LimitHands(Problem, Scale.Pull * seconds);
        }

        Sweeps = 0;
        Sweep(tolerance);
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

        most = hasHand ? most + came : Math.Max(most, came);
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
    /// Which contacts hold in the step that was solved: those that push, and those that held before and open by less than a quarter of the
    /// tolerance, as along what is round, where a chord leads away a little and comes back. What the solution left out
    /// holds where it overlaps.
    /// </summary>
    internal void FindHolding(double seconds)
    {
        deepest.PutBack();
        contacts.FindMeetings(seconds);
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Holds = c.Impulse > 0 || (c.IsLeftOut && c.Gap <= 0) || (c.Held && !c.IsElastic && c.Gap + (ContactSolver.Opening(Problem, c) * seconds) <= 0.25 * Scale.Length);
        }
    }

    /// <summary>Has a body come with another velocity, forces included: then the step is to be solved again.</summary>
    internal void Regain(int body, in Vector3D velocity, in Vector3D spin)
    {
        free[body].Velocity = velocity;
        free[body].Spin = spin;
    }

    /// <summary>Solves the step again from the impulses that it has.</summary>
    internal void SolveAgain(double tolerance)
    {
        BeginAnew();
        Sweep(tolerance);
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
        Sweeps += sweeps;
        if (Rules.RefinesNormals && NormalRefinement.IsNeeded(Problem, sweeps, tolerance))
        {
            BeginAnew();
            Sweeps += SolveNormals(tolerance);
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
        internal Vector3D Velocity;
        internal Vector3D Spin;
    }
}
