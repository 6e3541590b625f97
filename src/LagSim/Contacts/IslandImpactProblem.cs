using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// An impact as a contact problem that grows: first the bodies struck, then those that the impulse reaches over persistent contacts. Each
/// time it has grown, it continues from the impulses so far.
/// </summary>
internal sealed class IslandImpactProblem(ContactStep step, EventWork work)
{
    private NormalRefinement? normals; // made when an impact needs it
    private PlasticImpact? plastic; // so too
    private bool[] isReached = Array.Empty<bool>(); // whether the impulse has gone on from a body to those that it holds
    private Vector3D[] velocitiesBefore = Array.Empty<Vector3D>();
    private Vector3D[] spinsBefore = Array.Empty<Vector3D>();

    /// <summary>Its bodies and contacts, with the velocities after it as far as it is solved.</summary>
    internal ContactProblem Problem { get; } = new();

    /// <summary>Begins another.</summary>
    internal void Clear() => Problem.Clear();

    /// <summary>Adds a body with the velocity and the spin with which it comes.</summary>
    internal void AddBody(double mass, double radius, in Vector3D velocity, in Vector3D spin)
    {
        int body = Problem.AddBody(mass, radius, velocity, spin);
        if (body >= velocitiesBefore.Length)
        {
            int size = Math.Max(4, Problem.BodyCount * 2);
            Array.Resize(ref velocitiesBefore, size);
            Array.Resize(ref spinsBefore, size);
            Array.Resize(ref isReached, size);
        }

        velocitiesBefore[body] = velocity;
        spinsBefore[body] = spin;
        isReached[body] = double.IsPositiveInfinity(mass);
    }

    /// <summary>How much the impact has changed a body's velocity so far.</summary>
    internal Vector3D ChangeOf(int body) => Problem.Bodies[body].Velocity - velocitiesBefore[body];

    /// <summary>Whether the impact has changed how a body moves or turns.</summary>
    internal bool HasChanged(int body, in Vector3D velocity, in Vector3D spin) => velocity != velocitiesBefore[body] || spin != spinsBefore[body];

    /// <summary>Whether the impulse has passed from a body to those that it holds; it never does from a held body.</summary>
    internal bool IsReached(int body) => isReached[body];

    /// <summary>The impulse passes on from a body.</summary>
    internal void Reach(int body) => isReached[body] = true;

    /// <summary>Whether it has a contact.</summary>
    internal bool Has(in ContactPoint c)
    {
        bool has = false;
        for (int i = 0; i < Problem.ContactCount && !has; i++)
        {
            ref readonly SolverContact known = ref Problem.Contacts[i];
            has = known.First == c.First && known.Second == c.Second && known.Surface == c.Surface;
        }

        return has;
    }

    /// <summary>Solves it from the impulses so far.</summary>
    /// <param name="tolerance">In m/s: what sweeps leave.</param>
    /// <param name="sweeps">How many at most.</param>
    /// <param name="knownBodies">How many bodies were in it when it was solved last.</param>
    /// <param name="knownContacts">How many contacts.</param>
    internal void Solve(double tolerance, int sweeps, int knownBodies, int knownContacts)
    {
        int taken = ContactSolver.Solve(Problem, tolerance, sweeps, knownBodies, knownContacts);
        if (sweeps == ContactStep.MaxSweeps && step.Rules.RefinesNormals && !Problem.IsCrowd(step.Scale.Length) && NormalRefinement.IsNeeded(Problem, taken, tolerance))
        {
            GoBack();
            normals ??= new NormalRefinement();
            taken += normals.Solve(Problem, tolerance);
        }

        work.CountSweeps(taken, Problem.ContactCount);
    }

    /// <summary>Limits what hands may give, by the velocities before: the more bodies there are, the more that is.</summary>
    /// <param name="more">In m/s: what they may give beyond what stops the bodies.</param>
    internal void LimitHands(double more)
    {
        if (step.Rules.LimitsHands)
        {
            SwapVelocities();
            ContactSolver.LimitHands(Problem, more);
            SwapVelocities();
        }
    }

    /// <summary>Rebound and friction together may make energy where several contacts share bodies; then there is no rebound.</summary>
    internal void DropReboundsThatGain(double tolerance)
    {
        SwapVelocities();
        double before = Problem.KineticEnergy();
        SwapVelocities();
        if (!step.Rules.LimitsEnergy || (!step.Rules.BoundsHands && Problem.HasHand()) || !Problem.Gains(before))
        {
            return;
        }

        Problem.DropRebounds();
        SolveAnew(tolerance);
        if (Problem.Gains(before))
        {
            Problem.DropFriction();
            SolveAnew(tolerance);
        }
    }

    /// <summary>What closes after all that gets one velocity.</summary>
    internal void JoinWhatCloses(double speed)
    {
        plastic ??= new PlasticImpact();
        plastic.Apply(Problem, speed);
    }

    /// <summary>Whether a contact lasts that is solved without its rebound.</summary>
    internal bool KeepsWhatDoesNotRebound => step.Rules.KeepsWhatDoesNotRebound;

    /// <summary>
    /// Has each hand give no more in all its contacts together than it may; true if one would have given more, and the impact was solved again.
    /// </summary>
    internal void ShareHands(double tolerance)
    {
        if (ContactSolver.ShareHands(Problem))
        {
            SolveAnew(tolerance);
        }
    }

    /// <summary>Solves it again from no impulses.</summary>
    private void SolveAnew(double tolerance)
    {
        Problem.DropImpulses();
        GoBack();
        Solve(tolerance, ContactStep.MaxSweeps, 0, 0);
    }

    private void GoBack()
    {
        for (int i = 0; i < Problem.BodyCount; i++)
        {
            Problem.Bodies[i].Velocity = velocitiesBefore[i];
            Problem.Bodies[i].Spin = spinsBefore[i];
        }
    }

    private void SwapVelocities()
    {
        for (int i = 0; i < Problem.BodyCount; i++)
        {
            ref SolverBody body = ref Problem.Bodies[i];
            (body.Velocity, velocitiesBefore[i]) = (velocitiesBefore[i], body.Velocity);
            (body.Spin, spinsBefore[i]) = (spinsBefore[i], body.Spin);
        }
    }
}
