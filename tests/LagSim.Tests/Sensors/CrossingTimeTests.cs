using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Verification.References;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Tests.Rules;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sensors;

/// <summary>When bodies enter and leave, on every law of motion, against closed forms.</summary>
public sealed class CrossingTimeTests
{
    private const double Tick = 1.0 / (1L << 40);

    [Theory]
    [InlineData(SensorCoverage.Centre, 2.0)]
    [InlineData(SensorCoverage.Part, 2.5)]
    [InlineData(SensorCoverage.Whole, 1.5)]
    public void Ballistic_FallsBehindAPlane_AtTheRoot(SensorCoverage coverage, double height)
    {
        Scene scene = new SceneBuilder("fall").AddBody("ball", Ball(0.5), V(0, 10)).AddSensorPlane("deep", Vector3D.Up, 2.0, coverage).Build();
        Crossing enters = Assert.Single(All(Run(scene, 2)));
        Assert.True(enters.Entered && enters.Body == First && enters.Sensor == 0);
        Near(Math.Sqrt(2 * (10 - height) / Gravity), enters.Time.ToSeconds(), 2 * Tick);
        Assert.Equal(new EventKey(enters.Time, 0, EventKind.Crossing, First, First, 0, 0), enters.Key);
    }

    [Fact]
    public void Ballistic_UpAndDownThroughAPlane_LeavesAndEnters()
    {
        Scene scene = new SceneBuilder("throw").AddBody("ball", Ball(0.5), V(0, 0), V(0, 10)).AddSensorPlane("under", Vector3D.Up, 3.0).Build();
        double root = Math.Sqrt(100 - (2 * Gravity * 3));
        Same(All(Run(scene, 3)), 2 * Tick, (0, true), ((10 - root) / Gravity, false), ((10 + root) / Gravity, true));
    }

    [Theory]
    [InlineData(SensorCoverage.Centre, 1.0)]
    [InlineData(SensorCoverage.Part, 1.25)]
    [InlineData(SensorCoverage.Whole, 0.75)]
    public void Straight_ThroughASphere_EntersAndLeaves(SensorCoverage coverage, double reach)
    {
        Scene scene = new SceneBuilder("line").WithGravity(Floating).AddBody("ball", Ball(0.25), V(-3, 0.5), V(2)).AddSensorSphere("ring", V(0), 1, coverage).Build();
        double half = Math.Sqrt((reach * reach) - 0.25);
        Same(All(Run(scene, 4)), 2 * Tick, ((3 - half) / 2, true), ((3 + half) / 2, false));
    }

    /// <summary>A touch from one side is no crossing; a hair deeper is two.</summary>
    [Theory]
    [InlineData(0, 0)]
    [InlineData(1e-9, 0)]
    [InlineData(-1e-9, 2)]
    public void Touch_FromOneSide_IsNoCrossing(double off, int crossings)
    {
        Scene line = new SceneBuilder("graze").WithGravity(Floating).AddBody("ball", Ball(0.25), V(-3, 1 + off), V(1)).AddSensorSphere("ring", V(0), 1).Build();
        Assert.Equal(crossings, All(Run(line, 6)).Count);
        Scene apex = new SceneBuilder("apex").WithGravity(V(0, -10)).AddBody("ball", Ball(0.25), V(0), V(0, 10)).AddSensorPlane("over", V(0, -1), -5 - off).Build();
        Assert.Equal(crossings, All(Run(apex, 2)).Count);
        Scene inside = new SceneBuilder("inside").WithGravity(V(0, -10)).AddBody("ball", Ball(0.25), V(0), V(0, 10)).AddSensorPlane("under", V(0, 1), 5 + off).Build();
        Assert.Equal(1 + crossings, All(Run(inside, 2)).Count);
    }

    public static TheoryData<MotionLaw, double> Laws => new()
    {
        { MotionLaw.ClosedForm, 1e-9 },
        { MotionLaw.RungeKutta4, 1e-8 },
        { MotionLaw.DormandPrince54, 1e-6 },
    };

    [Theory]
    [MemberData(nameof(Laws))]
    public void Drag_UpAndDown_CrossesWhereExponentialsSay(MotionLaw law, double tolerance)
    {
        LinearDragFall fall = new(Gravity, 0.5);
        Scene scene = new SceneBuilder("drag").AddForce(Force.LinearDrag("air", 0.5), out ForceSet air)
            .AddBody("ball", new BodySpec(0.25, 1, 1, law, SimDuration.FromSeconds(1.0 / 128), air, 1e-9), V(0), V(0, 12)).AddSensorPlane("under", Vector3D.Up, 3.0).Build();
        double apex = Math.Log((12 - fall.Terminal) / -fall.Terminal) / 0.5;
        double up = Root(t => fall.Height(-3, 12, t), 0, apex);
        double down = Root(t => -fall.Height(-3, 12, t), apex, 10);
        Same(All(Run(scene, 5)), tolerance, (0, true), (up, false), (down, true));
    }

    [Fact]
    public void Kepler_RoundAndRound_CrossesWhereKeplersEquationSays()
    {
        KeplerOrbit orbit = new(0.5, 4);
        Scene scene = new SceneBuilder("orbit").WithGravity(Floating).AddForce(orbit.Pull, out ForceSet sun)
            .AddBody("planet", new BodySpec(0.01, 1, 1, MotionLaw.Automatic, forces: sun, tolerance: 1e-10), orbit.Position(0), orbit.StartVelocity)
            .AddSensorSphere("near", V(0), 1).Build();
        double enters = Root(t => orbit.Position(t).Length - 1, 0, 2);
        double leaves = Root(t => 1 - orbit.Position(t).Length, 2, 4);
        Simulation world = Run(scene, 8);
        Assert.Equal(MotionLaw.ClosedForm, Read(world, First, 1).Motion);
        Same(All(world), 1e-8, (enters, true), (leaves, false), (4 + enters, true), (4 + leaves, false));
    }

    [Fact]
    public void Sliding_OverALine_CrossesAtTheRoot()
    {
        Scene scene = new SceneBuilder("slide").AddPlane("floor", Vector3D.Up, V(0), friction: 0)
            .AddBody("ball", new BodySpec(0.25, 1, 0), V(0, 0.25), V(2)).AddSensorPlane("goal", V(-1), V(3)).AddSensorPlane("never", V(-1), V(3e3)).Build();
        Simulation world = Run(scene, 4);
        Assert.Equal(MotionLaw.Sliding, Read(world, First, 1).Motion);
        Same(All(world), 2 * Tick, (1.5, true));
    }

    [Fact]
    public void Rolling_OverALine_CrossesAtTheRoot()
    {
        // Slips until 5/7 of its speed is left, at 2 v / (7 mu g), and rolls on with that.
        Scene scene = new SceneBuilder("roll").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", new BodySpec(0.25, 1, 0, friction: 0.5), V(0, 0.25), V(7))
            .AddSensorPlane("slips", V(-1), V(1)).AddSensorPlane("rolls", V(-1), V(10)).Build();
        double drag = 0.5 * Gravity;
        double slips = 2 * 7 / (7 * drag);
        double way = (7 * slips) - (0.5 * drag * slips * slips);
        Simulation world = Run(scene, 4);
        Assert.Equal(MotionLaw.Rolling, Read(world, First, 1).Motion);
        Same(All(world), 1e-11, ((7 - Math.Sqrt(49 - (2 * drag))) / drag, true), (slips + ((10 - way) / 5), true));
    }

    [Fact]
    public void Resting_OnTheBoundary_CrossesNothing()
    {
        Scene scene = new SceneBuilder("rest").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(0.25, e: 0.5), V(0, 2))
            .AddSensorPlane("half", Vector3D.Up, 0.25).AddSensorPlane("all", Vector3D.Up, 0.5, SensorCoverage.Whole).AddSensorPlane("some", Vector3D.Up, 0.125, SensorCoverage.Part).Build();
        Simulation world = Run(scene, 60);
        Assert.Equal(MotionLaw.Resting, Read(world, First, 60).Motion);
        Assert.Empty(world.Crossings(At(30), At(60)));
        Assert.True(world.IsInside(First, 2, At(60)));
    }

    [Fact]
    public void Held_ByAHand_CrossesWhereTheHandsPathSays()
    {
        Scene scene = new SceneBuilder("hand").AddBody("ball", Ball(0.25), V(0)).WithGravity(Floating).AddSensorPlane("there", V(-1), V(0.125)).Build();
        Simulation world = Run(scene, 1,
        [
            ExternalEvent.Grab(At(0.1), 1, 1, First, V(0)), ExternalEvent.HoldKeyframe(At(0.1), 1, 2, First, V(0), V(2)), ExternalEvent.Release(At(0.8), 1, 3, First, V(0)),
        ]);
        double crossed = Root(t => HandPath.Position(V(0), V(2), SimDuration.FromSeconds(t)).X - 0.125, 0, 0.3, rises: true);
        Assert.Equal(MotionLaw.Held, Read(world, First, 0.2).Motion);
        Same(All(world), 1e-10, (0.1 + crossed, true));
    }

    [Fact]
    public void Members_OfAnIsland_CrossWhereTheirStepsGo()
    {
        // Two balls on a slope, one behind the other in touch, go down it like one without friction.
        Scene scene = new SceneBuilder("slope").AddPlane("slope", V(0.6, 0.8), V(0), friction: 0)
            .AddBody("low", new BodySpec(0.25, 1, 0), (V(0.6, 0.8) * 0.25) + (V(0.8, -0.6) * 0.5)).AddBody("high", new BodySpec(0.25, 1, 0), V(0.6, 0.8) * 0.25)
            .AddSensorPlane("down", V(-0.8, 0.6), -3.0).Build();
        Simulation world = Run(scene, 1.5);
        List<Crossing> crossings = [.. All(world)];
        Assert.Equal([First, Second], crossings.Select(c => c.Body));
        Near(Math.Sqrt(2 * 2.5 / (0.6 * Gravity)), crossings[0].Time.ToSeconds(), 2e-3);
        Near(Math.Sqrt(2 * 3 / (0.6 * Gravity)), crossings[1].Time.ToSeconds(), 2e-3);
    }

    [Fact]
    public void Bounces_BelowALine_CrossTwiceAHop()
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(0.5), V(0, 2.5)).AddSensorPlane("low", Vector3D.Up, 1.5).Build();
        double fall = Math.Sqrt(2 * 2 / Gravity);
        double down = Math.Sqrt(2 * 1 / Gravity);
        List<(double, bool)> expected = [(down, true)];
        for (int hop = 0; hop < 5; hop++)
        {
            double bounce = fall * ((2 * hop) + 1);
            expected.Add((bounce + (fall - down), false));
            expected.Add((bounce + fall + down, true));
        }

        Same(All(Run(scene, fall * 11)), 1e-11, [.. expected]);
    }

    [Fact]
    public void Players_PutTakeAndPlaceBodies_WhichCrossAtThatTick()
    {
        Scene scene = new SceneBuilder("players").WithGravity(Floating).WithSmallestRadius(0.25).AddBody("ball", Ball(0.25), V(9)).AddSensorSphere("ring", V(0), 1).Build();
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball(0.25), V(0), V(0));
        Simulation world = Run(scene, 5,
        [
            spawn, ExternalEvent.Remove(At(2), 1, 2, spawn.Body), ExternalEvent.Teleport(At(3), 1, 3, First, V(0.5), V(0)), ExternalEvent.Teleport(At(4), 1, 4, First, V(5), V(0)),
        ]);
        Assert.Equal(
            [
                Key(1, spawn.Body, true), Key(2, spawn.Body, false), Key(3, First, true), Key(4, First, false),
            ],
            All(world));
        Assert.True(world.IsInside(spawn.Body, 0, At(1)) && world.IsInside(spawn.Body, 0, At(2) - SimDuration.OneTick) && !world.IsInside(spawn.Body, 0, At(2)));
        Assert.False(world.IsInside(First, 0, At(1)) || world.IsInside(First, 0, At(4)));

        static Crossing Key(double seconds, BodyId body, bool entered) => new(new EventKey(At(seconds), 1, EventKind.Crossing, body, body, 0, 0), entered);
    }

    [Fact]
    public void Carried_ByABody_CrossesByTheirRelativeMotion()
    {
        SceneBuilder builder = new SceneBuilder("reach").WithGravity(Floating).AddBody("carrier", Ball(0.5), V(0), V(1)).AddBody("ball", Ball(0.5), V(10, 0.6), V(-1));
        SensorCoverage part = SensorCoverage.Part;
        Scene scene = builder.AddSensorSphere("reach", V(0), 1.5, part, carrier: "carrier").AddSensorSphere("ahead", V(3), 1, carrier: "carrier").Build();
        double chord = Math.Sqrt((2 * 2) - (0.6 * 0.6));
        Simulation world = Run(scene, 4.5);
        Assert.All(All(world), crossing => Assert.Equal(Second, crossing.Body)); // no sensor sees its carrier
        Same([.. All(world).Where(c => c.Sensor == 1)], 1e-11, ((10 - 3 - 0.8) / 2, true), ((10 - 3 + 0.8) / 2, false));
        Same([.. All(world).Where(c => c.Sensor == 0)], 1e-11, ((10 - chord) / 2, true));
    }

    [Fact]
    public void Carrier_ThatFallsOrBouncesOrIsTakenAway_TakesItsSensorAlong()
    {
        // The carrier falls by 5 t^2 and bounces; the mark lies 3 m beside where it does.
        Scene scene = new SceneBuilder("bounce").WithGravity(V(0, -10)).AddPlane("floor", Vector3D.Up, V(0)).AddBody("carrier", new BodySpec(1, 1, 1), V(0, 11))
            .AddBody("mark", new BodySpec(0.25, 1, 0), V(3, 0.25)).AddSensorSphere("near", V(0), 5, carrier: "carrier").Build();
        double down = Math.Sqrt(2 * (11 - 4.25) / 10); // from 4.25 m on the two are within 5 m
        double bounce = Math.Sqrt(2 * 10 / 10.0);
        Same(All(Run(scene, 2)), 1e-11, (down, true), ((2 * bounce) - down, false));

        ExternalEvent remove = ExternalEvent.Remove(At(1.25), 1, 2, First);
        Assert.Equal([At(1.25)], All(Run(scene, 3, [remove])).Skip(1).Select(c => c.Time));
        ExternalEvent away = ExternalEvent.Teleport(At(1.25), 1, 2, First, V(100, 5), V(0));
        ExternalEvent back = ExternalEvent.Teleport(At(1.5), 1, 3, First, V(1, 4), V(0));
        Assert.Equal([(At(1.25), false), (At(1.5), true)], All(Run(scene, 1.6, [away, back])).Skip(1).Select(c => (c.Time, c.Entered)));
    }

    [Fact]
    public void Filter_OfASensor_DecidesWhomItSees()
    {
        CollisionFilter pucks = new(2);
        Scene scene = new SceneBuilder("filter").WithGravity(Floating).AddBody("puck", Ball(0.25).With(pucks), V(-2, 0), V(1)).AddBody("hand", Ball(0.25), V(-2, 2), V(1))
            .AddSensorPlane("goal", V(-1), 0.0, filter: new CollisionFilter(1, 2)).Build();
        Assert.Equal([(First, At(2))], All(Run(scene, 4)).Select(c => (c.Body, c.Time)));

        // A filter that changes has it seen, and seen no more, at that tick.
        Simulation changed = Run(scene, 6,
        [
            ExternalEvent.SetFilter(At(1), 1, 1, Second, pucks), ExternalEvent.SetFilter(At(3), 1, 2, First, default), ExternalEvent.SetFilter(At(4), 1, 3, First, pucks),
        ]);
        Assert.Equal([(First, At(2), true), (Second, At(2), true), (First, At(3), false), (First, At(4), true)], All(changed).Select(c => (c.Body, c.Time, c.Entered)));
    }

    /// <summary>Rules change a body's filter where it crosses, which opens its path again there: as long as it is seen, that is no crossing
    /// more.</summary>
    [Fact]
    public void Filter_ThatRulesChangeAtACrossing_DoesNotFlicker()
    {
        Random from = new(20261128);
        int crossings = 0;
        for (int n = 0; n < 300; n++)
        {
            Vector3D normal = V(from.NextDouble() - 0.5, from.NextDouble() - 0.5, from.NextDouble() - 0.5);
            Scene scene = new SceneBuilder("flicker").WithGravity(n % 2 == 0 ? Floating : V(0, -9.81))
                .AddBody("puck", Ball(0.25), V(0.1, 0.2, 0.3), V(3 * from.NextDouble(), 1, 2)).AddBody("carrier", Ball(0.25), V(3, 3, 3), V(-1))
                .AddSensorPlane("line", normal, from.NextDouble()).AddSensorSphere("ring", V(1, 0.5, 1), 0.6 + from.NextDouble())
                .AddSensorSphere("reach", V(0), 2, carrier: "carrier").Build();
            GivenRules rules = new()
            {
                HearsSensor = (body, _) => body == First,
                Crossed = (w, crossing) => w.SetFilter(First, new CollisionFilter(++w.State<GivenState>().Count % 2 == 0 ? 1u : 3u)),
            };
            (int, bool)[] expected = [.. All(Run(scene, 3)).Where(c => c.Body == First).Select(c => (c.Sensor, c.Entered))];
            Assert.Equal(expected, All(Run(scene.With(rules, 1), 3)).Where(c => c.Body == First).Select(c => (c.Sensor, c.Entered)));
            crossings += expected.Length;
        }

        Assert.True(crossings > 600, $"{crossings} crossings");
    }

    /// <summary>A sensor thinner than the way of a tick is entered and left in one, and nothing hangs.</summary>
    [Fact]
    public void Chord_ShorterThanATick_IsCrossedAtOneTick()
    {
        Scene scene = new SceneBuilder("fast").WithGravity(Floating).AddBody("ball", Ball(1), V(-1e6), V(1e6)).AddSensorSphere("speck", V(0, 0), 1e-9).Build();
        List<Crossing> crossings = [.. All(Run(scene, 2))];
        Assert.Equal([true, false], crossings.Select(c => c.Entered));
        Assert.Equal(crossings[0].Time, crossings[1].Time);
        Assert.Equal([0u, 1u], crossings.Select(c => c.Key.Round));
        Assert.False(Run(scene, 2).IsInside(First, 0, At(2)));
    }

    /// <summary>Hashes have what bodies crossed and are inside of; and a scene's has its sensors.</summary>
    [Fact]
    public void Hashes_CountSensors()
    {
        static Scene Made(double offset, SensorCoverage coverage = SensorCoverage.Centre) =>
            new SceneBuilder("hash").AddBody("ball", Ball(0.5), V(0, 10)).AddSensorPlane("deep", Vector3D.Up, offset, coverage).Build();
        Assert.Equal(4, new[] { Made(2), Made(3), Made(2, SensorCoverage.Part), new SceneBuilder("hash").AddBody("ball", Ball(0.5), V(0, 10)).Build() }.Select(s => s.Hash).Distinct().Count());
        Simulation early = Run(Made(3), 2);
        Simulation late = Run(Made(2), 2);
        Assert.Equal(early.StateHash(At(1)), late.StateHash(At(1)));
        Assert.Equal(early.EventHash(At(1)), late.EventHash(At(1)));
        SimTime between = All(early)[0].Time;
        Assert.NotEqual(early.StateHash(between), late.StateHash(between));
        Assert.Equal(early.StateHash(At(2)), late.StateHash(At(2)));
        Assert.NotEqual(early.EventHash(At(2)), late.EventHash(At(2)));
    }

    [Fact]
    public void BadInput_IsRefusedWithASentence()
    {
        Refused("The radius of sensor 'a' is 0;", b => b.AddSensorSphere("a", V(0), 0));
        Refused("The normal of sensor 'a' is", b => b.AddSensorPlane("a", V(0), 1.0));
        Refused("The coverage of sensor 'a' is 3", b => b.AddSensorSphere("a", V(0), 1, (SensorCoverage)3));
        Refused("The point of sensor 'a' is", b => b.AddSensorPlane("a", V(1), V(double.NaN)));
        Refused("Two parts of scene 'bad' are named 'ball'", b => b.AddSensorSphere("ball", V(0), 1));
        Refused("a periodic box goes with none", b => b.WithGravity(Floating).WithPeriodicBox(V(9, 9, 9)).AddSensorSphere("a", V(0), 1));
        Refused("The carrier of sensor 'a' is 'bell'; it must be the name of a body", b => b.AddSensorSphere("a", V(0), 1, carrier: "bell"));
        Refused("has 1025 sensors; at most 1024", b => Enumerable.Range(0, 1025).ToList().ForEach(n => b.AddSensorSphere($"a{n}", V(0), 1)));
        Scene scene = new SceneBuilder("good").AddSensorSphere("a", V(0), 1).Build();
        Assert.Equal(0, scene.SensorNamed("a"));
        Assert.Throws<ArgumentException>(() => scene.SensorNamed("b"));
        Assert.Throws<ArgumentOutOfRangeException>(() => new Simulation(scene).IsInside(First, 1, At(0)));

        static void Refused(string words, Action<SceneBuilder> add)
        {
            SceneBuilder builder = new SceneBuilder("bad").AddBody("ball", Ball(0.5), V(4, 4, 4));
            Assert.Contains(words, Assert.Throws<SceneException>(() =>
            {
                add(builder);
                builder.Build();
            }).Message, StringComparison.Ordinal);
        }
    }

    private static IReadOnlyList<Crossing> All(Simulation world) => world.Crossings(SimTime.MinValue, SimTime.MaxValue);

    private static void Same(IReadOnlyList<Crossing> actual, double tolerance, params (double Seconds, bool Entered)[] expected)
    {
        Assert.Equal(expected.Select(e => e.Entered), actual.Select(c => c.Entered));
        for (int n = 0; n < expected.Length; n++)
        {
            Near(expected[n].Seconds, actual[n].Time.ToSeconds(), tolerance);
        }
    }

    /// <summary>Where a function changes its sign from below, or from above, by bisection.</summary>
    private static double Root(Func<double, double> f, double low, double high, bool rises = false)
    {
        bool isUp = rises || f(low) < 0;
        for (int n = 0; n < 200; n++)
        {
            double middle = 0.5 * (low + high);
            (low, high) = f(middle) < 0 == isUp ? (middle, high) : (low, middle);
        }

        return high;
    }
}
