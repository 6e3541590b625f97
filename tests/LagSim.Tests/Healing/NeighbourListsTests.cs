using System;
using System.Collections.Generic;
using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>Whoever touches is on a list, now and in the past; against a look at every pair.</summary>
public sealed class NeighbourListsTests
{
    private const double Near = 1e-6;
    private const int Bodies = 120;
    private const int Worlds = 20;

    [Theory]
    [InlineData(1, false, 1)]
    [InlineData(2, true, 1)]
    [InlineData(3, false, 1e6)]
    [InlineData(4, false, 1e-3)]
    public void Candidates_OfAll_HaveEveryPairThatTouches(int seed, bool boxed, double faster)
    {
        int all = 0;
        for (int world = 0; world < Worlds; world++)
        {
            (int touching, int missed, int listed) = Count(new World((100 * seed) + world, boxed, faster), Near);
            Assert.Equal(0, missed);
            Assert.True(listed < Bodies * Bodies / 3, $"{listed} are listed");
            all += touching;
        }

        Assert.True(all > 50, $"{all} touch");
    }

    [Fact]
    public void Check_IndexThatLooksLessFar_IsSeenToMiss()
    {
        int missed = 0;
        for (int world = 0; world < Worlds; world++)
        {
            missed += Count(new World(100 + world, false, 1), -0.6).Missed;
        }

        Assert.True(missed > 5, $"{missed} missed");
    }

    /// <summary>
    /// A step where forces are strong is short, and its polynomial says nothing beyond its end: there it leads out of any shell at
    /// once. A body that is asked for again at every instant gets nowhere (from <c>check --seed 30010</c>).
    /// </summary>
    [Fact]
    public void Leaves_AShortStepOfStrongForces_NotBeforeItsEnd()
    {
        SimTime end = SimTime.FromSeconds(1e-5);
        DenseOutput dense = new(V(1e3), V(1e9), V(1e15));
        MotionSegment path = new(MotionLaw.RungeKutta4, At(0), end, V(0), V(1), V(100));
        Assert.Equal(SimTime.MaxValue, new Shell(V(0), 0.01, 0.1).Leaves(path, dense, At(0), default));

        // The control: what goes on for longer leaves, and not so soon that it is asked for at every instant.
        MotionSegment longer = new(MotionLaw.RungeKutta4, At(0), At(1), V(0), V(1), V(100));
        Assert.InRange(new Shell(V(0), 0.01, 0.1).Leaves(longer, default, At(0), default).ToSeconds(), 1e-3, 0.02);
        Assert.Equal(At(0), new Shell(V(1), 0.01, 0.1).Leaves(path, dense, At(0), default)); // it is outside
    }

    /// <summary>However long a piece is: what bends it late counts from the first.</summary>
    [Fact]
    public void Leaves_LongPiecesAtRandom_NotBeforeItIsSaid()
    {
        Random random = new(11);
        int left = 0, stayed = 0;
        for (int n = 0; n < 4000; n++)
        {
            double seconds = 0.1 + (5 * random.NextDouble());
            DenseOutput dense = new(Draw(), Draw(), Draw());
            MotionSegment path = new(MotionLaw.RungeKutta4, At(0), At(seconds), V(0), Draw(), Draw());
            Shell shell = new(V(0), 0.01, 0.1);
            SimTime leaves = shell.Leaves(path, dense, At(0), default);
            stayed += leaves == SimTime.MaxValue ? 1 : 0;
            left += leaves < At(seconds) ? 1 : 0;
            for (int k = 0; k <= 50; k++)
            {
                double t = Math.Min(seconds, leaves.ToSeconds()) * k / 50;
                Assert.InRange(path.PositionAt(t, dense).Length, 0, 0.01 * (1 + 1e-9));
            }
        }

        Assert.True(left > 100 && stayed > 100, $"{left} leave, {stayed} stay");

        Vector3D Draw() => new Vector3D(random.NextDouble() - 0.5, random.NextDouble() - 0.5, 0) * Math.Pow(10, -7 * random.NextDouble());
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1e-160)] // its square is none, or almost
    [InlineData(2.6e-162)]
    [InlineData(5e-324)]
    public void Leaves_WhatHardlyMoves_Never(double speed)
    {
        MotionSegment path = new(MotionLaw.Ballistic, At(0), SimTime.MaxValue, V(0), V(speed, speed), V(0));
        foreach (Vector3D centre in new[] { V(0), V(0.05), V(-0.05) })
        {
            Assert.True(new Shell(centre, 0.1, 0.1).Leaves(path, default, At(0), default) > At(1e6));
        }
    }

    [Fact]
    public void Candidates_InAHeal_HaveWhoWasThereThen()
    {
        World world = new(5, false, 1);
        NeighbourLists index = world.Index(Near);
        for (int slot = 0; slot < Bodies; slot++)
        {
            index.Candidates(slot, world.Radius(slot), At(0), 0, out _);
        }

        HashSet<(int, int)> before = [];
        for (int slot = 0; slot < Bodies; slot++)
        {
            foreach (int other in index.Candidates(slot, world.Radius(slot), At(0), 0, out _))
            {
                before.Add((slot, other));
            }
        }

        // All but the first go far away, each a second later; then the first is looked at again where it was.
        for (int slot = 1; slot < Bodies; slot++)
        {
            world.Open(slot, At(1), V(1000 + (10 * slot)), V(0));
            index.Candidates(slot, world.Radius(slot), At(1), 0, out _);
        }

        int now = index.Candidates(0, world.Radius(0), At(0), 0, out _).Length; // the control: that is not asked of the present
        int then = 0;
        Span<int> healed = index.Candidates(0, world.Radius(0), At(0), 1, out SimTime until);
        Assert.True(until > At(0) && until < At(1), $"{until}");
        foreach (int other in healed)
        {
            then += before.Contains((0, other)) ? 1 : 0;
        }

        foreach (int other in index.CandidatesAt(0, world.Radius(0), At(0), isHealing: true))
        {
            Assert.InRange(other, 0, Bodies - 1);
        }

        Assert.True(then > 0 && then == CountOf(before, 0), $"{then} of {CountOf(before, 0)}");
        Assert.True(now < then, $"{now} now");
    }

    [Fact]
    public void Forgotten_AndHistoryThatIsDropped_AreNotFound()
    {
        World world = new(6, false, 1);
        NeighbourLists index = world.Index(Near);
        for (int slot = 0; slot < Bodies; slot++)
        {
            index.Candidates(slot, world.Radius(slot), At(0), 0, out _);
        }

        for (int slot = 1; slot < Bodies; slot++)
        {
            index.Forget(slot);
        }

        Assert.Equal(0, index.Candidates(0, world.Radius(0), At(0), 0, out _).Length);
        index.Add(1, world.Radius(1), world.Timelines.Last(0), At(0), At(0.1));
        Assert.Contains(1, index.Candidates(0, world.Radius(0), At(0), 1, out _).ToArray());
        SimTime[] spans = [At(0), At(0.05), At(0.1)];
        for (int n = 0; n < 100; n++)
        {
            index.Add(1, world.Radius(1), world.Timelines.Last(0), spans[n % 2], spans[(n % 2) + 1]); // what is healed again and again
        }

        Assert.Single(index.Candidates(0, world.Radius(0), At(0.01), 3, out _).ToArray());
        index.DropBefore(At(5));
        Assert.DoesNotContain(1, index.Candidates(0, world.Radius(0), At(0), 2, out _).ToArray());
    }

    private static int CountOf(HashSet<(int Slot, int Other)> pairs, int slot)
    {
        int count = 0;
        foreach ((int one, int _) in pairs)
        {
            count += one == slot ? 1 : 0;
        }

        return count;
    }

    /// <summary>
    /// Asks for everybody, and counts the pairs that touch while both answers are whole, those of them that neither answer has, and how many are named.
    /// </summary>
    private static (int Touching, int Missed, int Listed) Count(World world, double near)
    {
        NeighbourLists index = world.Index(near);
        HashSet<(int, int)> named = [];
        SimTime[] until = new SimTime[Bodies];
        int listed = 0;
        for (int slot = 0; slot < Bodies; slot++)
        {
            HashSet<int> once = [];
            foreach (int other in index.Candidates(slot, world.Radius(slot), At(0), 0, out until[slot]))
            {
                Assert.True(once.Add(other), $"{other} is named twice to {slot}");
                named.Add((slot, other));
                named.Add((other, slot));
                listed++;
            }

            Assert.True(until[slot] > At(0));
        }

        int touching = 0;
        int missed = 0;
        for (int a = 0; a < Bodies; a++)
        {
            for (int b = 0; b < a; b++)
            {
                if (world.Touch(a, b, SimTime.Min(until[a], until[b])))
                {
                    touching++;
                    missed += named.Contains((a, b)) ? 0 : 1;
                }
            }
        }

        return (touching, missed, listed);
    }

    /// <summary>Balls of many sizes and speeds, some at rest, that fly through each other.</summary>
    private sealed class World
    {
        private readonly double[] radii = new double[Bodies];
        private readonly PeriodicBox box;
        private readonly double faster;

        internal World(int seed, bool boxed, double faster)
        {
            this.faster = faster;
            Random random = new(seed);
            box = boxed ? new PeriodicBox(V(12, 12, 12)) : default;
            Vector3D gravity = boxed ? V(0) : V(0, -9.81 * faster * faster);
            for (int slot = 0; slot < Bodies; slot++)
            {
                radii[slot] = random.Next(12) == 0 ? 1.1 * random.NextDouble() : 0.2 + (0.3 * random.NextDouble());
                Timelines.AddSlot(slot);
                Vector3D place = V(random.NextDouble(), random.NextDouble(), random.NextDouble()) * 12;
                Vector3D velocity = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * (faster * random.Next(20));
                Append(slot, At(0), random.Next(5) == 0
                    ? MotionSegment.AtRest(At(0), place)
                    : new MotionSegment(MotionLaw.Ballistic, At(0), SimTime.MaxValue, place, velocity, gravity));
            }
        }

        internal TimelineStore Timelines { get; } = new(default);

        internal NeighbourLists Index(double near) => new(Timelines, 2, 5 * faster, near, 1e-9, box);

        internal double Radius(int slot) => radii[slot];

        internal void Open(int slot, SimTime time, Vector3D place, Vector3D velocity) =>
            Append(slot, time, new MotionSegment(MotionLaw.Ballistic, time, SimTime.MaxValue, place, velocity, V(0)));

        internal bool Touch(int a, int b, SimTime until)
        {
            MotionSegment pathA = Timelines.Segment(Timelines.Last(a));
            MotionSegment pathB = Timelines.Segment(Timelines.Last(b));
            Vector3D apart = pathB.Position - pathA.Position;
            return TimeOfImpact.WithSphere(
                pathA, default, pathB.At(pathB.Position + (box.Nearest(apart) - apart)), default, radii[a] + radii[b], At(0), until, out _);
        }

        private void Append(int slot, SimTime time, in MotionSegment segment)
        {
            BodyId id = BodyId.OfScene(slot);
            Timelines.Append(slot, id, new EventKey(time, 0, EventKind.Start, id, id, 0, 0), segment, default);
        }
    }
}
