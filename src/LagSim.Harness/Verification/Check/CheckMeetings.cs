using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>Two players of a seeded session who act at once on one body, neither knowing of the other yet.</summary>
/// <remarks>
/// The first act wakes the body, so the second one meets it awake, in the middle of a contact step: what a body that enters contact, or is
/// thrown out of rest, never is. Which of the two is heard of first depends on the links. Drawn from streams of their own, and in some
/// sessions only, so that all others stay the same.
/// </remarks>
internal static class CheckMeetings
{
    private const double Percent = 20;
    private const int MaxMeetings = 4;
    private const double LongestSeconds = 0.1;
    private const ulong FirstActions = 1000;

    /// <summary>Adds the acts of both players, if the session has any.</summary>
    internal static void AddTo(List<CheckAction> actions, CheckScene room, int players, SeededRandom random, ulong attempt)
    {
        if (!random.Fork(0).IsLucky(Percent))
        {
            return;
        }

        SeededRandom from = random.Fork(FirstActions + attempt);
        List<CheckAction> all = [.. actions];
        int meetings = 1 + from.NextInt(MaxMeetings);
        for (int i = 0; i < meetings; i++)
        {
            int body = room.DrawBody(from), one = from.NextInt(players), other = (one + 1 + from.NextInt(players - 1)) % players;
            double at = from.NextDouble() * Math.Min(room.BusySeconds, CheckCase.Length - LongestSeconds);
            all.Add(new CheckAction(at, one, EventKind.Impulse, body, -1, default, room.DrawVelocity(1), room.SpecOf(body)));
            all.Add(new CheckAction(
                at + (from.NextDouble() * LongestSeconds), other, EventKind.SetVelocity, body, -1, default, room.DrawVelocity(12),
                    room.SpecOf(body)));
        }

        CheckHands.PutInOrder(actions, all);
    }
}
