using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <summary>The values of scene files that are more than a number, a vector or a text, read with what they are allowed to be.</summary>
internal static class SceneJsonValues
{
    /// <summary>Reads the name of a scene or of a part.</summary>
    internal static string Name(ref JsonCursor cursor)
    {
        string name = cursor.String();
        return PartName.Problem(name) is string problem ? throw cursor.Fail(problem) : name;
    }

    /// <summary>Reads the law of a body's motion.</summary>
    internal static MotionLaw Motion(ref JsonCursor cursor)
    {
        string name = cursor.String();
        return MotionNames.TryParseFlight(name, out MotionLaw law)
            ? law
            : throw cursor.Fail($"the motion {JsonFault.Quote(name)} is unknown; allowed are {MotionNames.Quoted}");
    }

    /// <summary>Reads a set of peers, by their numbers.</summary>
    internal static PeerSet Peers(ref JsonCursor cursor)
    {
        List<int> peers = new();
        cursor.EnterArray("an array of the numbers of peers");
        while (cursor.NextElement())
        {
            double number = cursor.Number();
            if (!(number >= 0 && number <= PeerSet.MaxPeer && number == Math.Floor(number)))
            {
                throw cursor.Fail(
                    $"the peer {number:R} cannot be granted a right; it must be a whole number between 0 and {PeerSet.MaxPeer}");
            }

            if (peers.Contains((int)number))
            {
                throw cursor.Fail($"the peer {number:R} stands here twice; each may stand once");
            }

            peers.Add((int)number);
        }

        return PeerSet.Of(peers.ToArray());
    }

    /// <summary>
    /// Reads the length of a step. Zero, which a <see cref="BodySpec"/> takes for the default, and what is no duration are refused here.
    /// </summary>
    internal static SimDuration Step(ref JsonCursor cursor)
    {
        double seconds = cursor.Number();
        return seconds is >= 1e-6 and <= 1
            ? SimDuration.FromSeconds(seconds)
            : throw cursor.Fail($"the step is {seconds:R} s; it must lie between 1E-06 and 1 s");
    }

    /// <summary>Reads 32 bits as a number.</summary>
    internal static uint Bits(ref JsonCursor cursor) => (uint)cursor.Whole(uint.MaxValue);
}
