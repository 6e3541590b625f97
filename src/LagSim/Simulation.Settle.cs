using System;
using LagSim.Contacts;

namespace LagSim;

/// <content>What friction drives together in an impact.</content>
public sealed partial class Simulation
{
    /// <summary>What an impact leaves of closing below this part of the largest speed is its rounding.</summary>
    private const double SettledPart = 1e-12;

    private readonly LastingContactSolver settling = new();
    private Rub[] settlingRubs = Array.Empty<Rub>();

    /// <summary>Leaves to the next round what friction drives together: only a test's negative control sets it.</summary>
    internal bool LeavesDriven { get; set; }

    /// <summary>
    /// Friction acts once the impulses along the normals are known, and of several contacts that of one may drive another together. Where that is so slow that
    /// no rebound comes of it, the contacts are solved once more, without a rebound and along the normals and across them at once: nothing closes then. Else
    /// what is jammed between two, as a body between a wall and what slips down it, would be struck round after round, each of which takes a part of what
    /// closes, and again as soon as gravity has made it slip by as much as rounding.
    /// </summary>
    private void SettleDriven()
    {
        if (contactCount < 2 || LeavesDriven)
        {
            return; // across its own normal friction drives nothing together
        }

        double most = 0;
        bool isPushed = false;
        for (int i = 0; i < partyCount; i++)
        {
            most = Math.Max(most, partyVelocities[i].Length);
            isPushed |= double.IsPositiveInfinity(partyMasses[i]);
        }

        bool closes = false;
        double settled = Math.Max(IslandStep.RoundingSpeed, SettledPart * most);
        for (int i = 0; i < contactCount && !isPushed; i++)
        {
            closes |= IsDriven(contacts[i], settled);
        }

        if (!closes)
        {
            return; // or a hand takes part, which presses whatever else does
        }

        if (settlingRubs.Length < contactCount)
        {
            settlingRubs = new Rub[contactCount * 2];
        }

        for (int i = 0; i < contactCount; i++)
        {
            // What closes faster keeps that speed, for it has an impact of its own to come; what opens may be brought back to touching, and no further.
            contacts[i].Target = Math.Min(0, ImpactSolver.Opening(contacts[i], partyVelocities));
            contacts[i].Target = IsDriven(contacts[i], 0) ? 0 : contacts[i].Target;
            contacts[i].Restored = contacts[i].Target;
            settlingRubs[i] = new Rub { Friction = coefficients[i] };
        }

        settling.Solve(
            contacts.AsSpan(0, contactCount), settlingRubs.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyRadii.AsSpan(0, partyCount),
            partyVelocities.AsSpan(0, partyCount), partySpins.AsSpan(0, partyCount), LastingContactSolver.Start.Anew, LastingContactSolver.UsualTurns);
    }

    /// <summary>Whether two close faster than rounding has them, and so slowly that their rebound would rise less than a hop.</summary>
    private bool IsDriven(in ContactPoint c, double settled)
    {
        double closing = -ImpactSolver.Opening(c, partyVelocities);
        return closing > settled && closing < HopSpeed(Pressing(c));
    }
}
