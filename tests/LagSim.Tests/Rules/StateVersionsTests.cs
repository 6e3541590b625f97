using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>States of rules are kept by the pages that differ, and read as they were.</summary>
public sealed class StateVersionsTests
{
    /// <summary>Versions that are kept and given back at random, of states that change a little, grow and shrink, are the states that were added.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Versions_KeptAtRandom_AreTheStatesThatWereAdded(int seed)
    {
        Random random = new(seed);
        StateVersions versions = new();
        List<(StateVersion? Version, byte[] State)> kept = [];
        byte[] state = new byte[16];
        for (int n = 0; n < 3000; n++)
        {
            if (random.Next(10) == 0)
            {
                Array.Resize(ref state, random.Next(20) == 0 ? 16 : 16 + random.Next(20_000));
            }

            if (random.Next(3) == 0)
            {
                int place = random.Next(state.Length + 1); // a timer that is set, or is gone
                state = random.Next(2) == 0 ? [.. state[..place], .. new byte[16], .. state[place..]]
                    : state.Length >= 32 && place + 16 <= state.Length ? [.. state[..place], .. state[(place + 16)..]] : state;
            }

            state[random.Next(state.Length)]++;
            StateVersion? like = kept.Count > 0 ? kept[random.Next(kept.Count)].Version : null;
            kept.Add((versions.Add(state, like), (byte[])state.Clone()));
            while (kept.Count > 30)
            {
                int gone = random.Next(kept.Count);
                StateVersion? version = kept[gone].Version;
                versions.Replace(ref version, null);
                kept.RemoveAt(gone);
            }

            (StateVersion? one, byte[] expected) = kept[random.Next(kept.Count)];
            (StateVersion? other, byte[] others) = kept[random.Next(kept.Count)];
            Assert.True(one!.IsSameAs(expected));
            Assert.True(one.Bytes.SequenceEqual(expected));
            Assert.InRange(one.Head.Length, Math.Min(StatePage.LeastBytes, expected.Length), StatePage.MostBytes);
            Assert.True(expected.AsSpan().StartsWith(one.Head));
            Assert.InRange(one.PageCount, 1, Math.Max(1, expected.Length / StatePage.LeastBytes));
            Assert.Equal(expected.AsSpan().SequenceEqual(others), one.IsSameAs(other!)); // also false: the control
        }

        foreach ((StateVersion? version, _) in kept)
        {
            StateVersion? last = version;
            versions.Replace(ref last, null);
        }

        Assert.Equal(0, versions.Bytes);
    }

    /// <summary>A change of one number in a large state keeps one page more, and a change of all of them all.</summary>
    [Theory]
    [InlineData(false, StatePage.MostBytes + (40 * 8))]
    [InlineData(true, (40 * StatePage.MostBytes) + (40 * 8))]
    public void Add_KeepsWhatDiffers(bool all, long more)
    {
        StateVersions versions = new();
        byte[] state = new byte[40 * StatePage.MostBytes];
        StateVersion first = versions.Add(state, null);
        long before = versions.Bytes;
        for (int at = 0; at < state.Length; at += all ? 1 : state.Length)
        {
            state[at]++;
        }

        versions.Add(state, first);
        Assert.Equal(more, versions.Bytes - before);
    }

    /// <summary>What moves all that is behind it, such as a timer that is set and gone again and again, costs no more than what changes in place.</summary>
    [Fact]
    public void Add_OfWhatMoves_KeepsNoMore()
    {
        StateVersions versions = new();
        Random random = new(1);
        byte[] state = new byte[40 * StatePage.MostBytes];
        random.NextBytes(state);
        StateVersion last = versions.Add(state, null);
        long before = versions.Bytes;
        for (int n = 0; n < 1000; n++)
        {
            int place = 16 * random.Next(4);
            state = state.Length == 40 * StatePage.MostBytes ? [.. state[..place], .. new byte[16], .. state[place..]] : [.. state[..place], .. state[(place + 16)..]];
            last = versions.Add(state, last);
            Assert.True(last.IsSameAs(state));
        }

        Assert.InRange(versions.Bytes - before, 1000, 1000 * ((2 * StatePage.MostBytes) + (80 * 8)));
    }

    /// <summary>
    /// A ball of a thousand, each of which has a state, is struck thousands of times: only what changes is kept. Copies of all would end the
    /// world before.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)] // and what is behind a timer moves with each
    public void ManyBodiesWithAState_OfWhichOneIsStruckOften_DoNotEndTheWorld(bool setsTimers)
    {
        GivenRules rules = new(bodies: true)
        {
            Start = w =>
            {
                for (int n = 0; n < 1000; n++)
                {
                    w.State<GivenState>(BodyId.OfScene(n)).Count = 1;
                }
            },
            Hears = (_, _, _) => true,
            Contact = (w, c) =>
            {
                if (w.State<GivenState>(c.First).Count++ % 2 == 0 && setsTimers)
                {
                    w.SetTimer(1, SimDuration.FromSeconds(5));
                }
                else
                {
                    w.CancelTimer(1);
                }
            },
        };
        SceneBuilder builder = new SceneBuilder("gap").WithGravity(Floating).AddPlane("floor", Vector3D.Up, 0).AddPlane("roof", V(0, -1), -0.203, filter: new CollisionFilter(2, 2));
        for (int n = 0; n < 1000; n++)
        {
            builder.AddBody($"ball {n}", new BodySpec(0.1, 1, 1, filter: n == 0 ? new CollisionFilter(3, 3) : default), V(n, 0.1), n == 0 ? V(0, 80) : V(0));
        }

        Simulation world = new(builder.WithRules(rules).Build(), KeepAll);
        world.AdvanceTo(At(1.2));
        Assert.True(world.TryReadRules(BodyId.OfScene(0), At(1.2), out GivenState struck));
        Assert.InRange(struck.Count, 31_900, 32_100);
    }
}
