using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// What a player does to bodies that touch, awake or asleep, under forces of any kind and rate: no energy comes of it but what the act gives.
/// </summary>
/// <remarks>
/// An act in the middle of a contact step may make a force far faster than the step follows; where it went on until the step's end, a drag
/// threw back what it should have stopped. So it did where it acted on another ball, which the act reaches, at its new velocity for as long as
/// the step that was cut short. Worlds are drawn: masses from 1e-6 to 1e6 kg, others up to 1000 times as heavy, rates from 1 to 2^22 1/s,
/// speeds from 0.1 to 1000 m/s, one to three balls on a floor, every force and act. All forces take energy or have a potential, so that the
/// sum only falls.
/// </remarks>
internal sealed class ContactEntryCase : IHardCase
{
    private const double Radius = 0.1;
    private const double Fastest = 1 << 22; // 1/s
    private const double Permitted = 1e6; // 1/s, of forces whose rate is known before
    private const double LongestStep = 1.0 / 64, ShortestStep = 1.0 / (1 << 20);
    private const double StepsOfARate = 16;
    private const double FastForASlowStep = 1 << 14; // 1/s; far more than the longest step follows
    private const int MostDrawn = 4;
    private const int Kinds = (int)Medium.Supplied + 1;

    public string Name => "contact-entry";

    public string Title => "acts on what touches, under forces of rates to 2^22 1/s and masses of 1e-6 to 1e6: no energy is made";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        int worlds = context.Size(6, 100); // of each kind; of those that are drawn, some take too long
        foreach (Medium kind in Enum.GetValues<Medium>())
        {
            double worst = 0;
            int read = 0;
            for (int n = 0; read < worlds && n < MostDrawn * worlds; n++)
            {
                Random random = new(unchecked(((int)context.Seed * 1_000_003) + (((n * Kinds) + (int)kind) * 1_299_709)));
                if (Gain(context, new Drawn(random, kind)) is double gain)
                {
                    worst = Worst([worst, gain]);
                    read++;
                }

                context.Report(((double)kind + ((double)read / worlds)) / Kinds);
            }

            yield return Row(kind, read, read == worlds ? worst : double.NaN);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (Medium kind in Enum.GetValues<Medium>().Where(k => k is not (Medium.Spring or Medium.Pull)))
        {
            // The act's own velocity for a whole step of the clock that was good for what lay there.
            double worst = 0;
            for (int n = 0; n < 100; n++)
            {
                Drawn drawn = new(new Random((n * Kinds) + (int)kind), kind);
                double step = Math.Min(Math.Sqrt(2 * drawn.Tolerance / Gravity), LongestStep);
                Vector3D velocity = drawn.Velocity, late = velocity + (drawn.AccelerationAt(drawn.Mass, V(0, Radius), velocity) * step);
                double gain = 0.5 * drawn.Mass * (late.LengthSquared - velocity.LengthSquared);
                BodyState state = new(V(0, Radius), velocity, MotionLaw.Constrained);
                double pull = drawn.AccelerationAt(drawn.Mass, V(0, Radius), velocity).Length;
                worst = Math.Max(worst, gain / drawn.Slack(drawn.Mass, state, pull, pull));
            }

            yield return Row(kind, 100, worst) with { Note = "the step goes on as it was" };
        }
    }

    private HardRow Row(Medium kind, int worlds, double gain) => new(
        Name, FormattableString.Invariant($"{kind.ToString().ToLowerInvariant()}, {worlds} worlds"), gain, "energy_gained_over_reading", 1,
        "within a step a velocity is that of its middle, off by a h/2: m (v a h/2 + (a h/2)^2/2) of each body, before and after, and a millionth;"
            + " h is 1/16 of the force's own time, or 2^-20 s",
        "the energy right after the act");

    /// <summary>
    /// The greatest energy that a world has after the act, less what it had right after, over what reading may be off by; null if it could
    /// not be played so far.
    /// </summary>
    private static double? Gain(HardContext context, in Drawn drawn)
    {
        Simulation world = context.Simulate(drawn.Scene, SimDuration.FromSeconds(10));
        long events = 20_000;
        if (!world.TryAdvanceTo(drawn.At, ref events))
        {
            return null;
        }

        world.Submit(drawn.Act.Stamp(drawn.At, 1, 1));
        events = 100_000;
        if (!world.TryAdvanceTo(drawn.At, ref events))
        {
            return null;
        }

        (double first, double firstSlack) = Read(world, drawn);
        double worst = 0;
        for (int n = 1; n <= 80; n++)
        {
            events = 4_000;
            SimDuration later = SimDuration.FromSeconds(0.2 * Math.Pow(2, (n - 80) * 0.25)); // from 0.2 us on
            if (!world.TryAdvanceTo(drawn.At + later, ref events) || world.LostBodies().Count > 0)
            {
                break; // what leaves takes its energy along
            }

            (double energy, double slack) = Read(world, drawn);
            worst = Worst([worst, (energy - first) / (firstSlack + slack)]);
        }

        return worst;
    }

    private static (double Energy, double Slack) Read(Simulation world, in Drawn drawn)
    {
        double slack = 0;
        for (int n = 0; n < world.BodyCount; n++)
        {
            BodyId body = world.BodyAt(n);
            if (world.TryRead(body, world.SimulatedTo, out BodyState state))
            {
                double mass = world.SpecOf(body).Mass;
                BodyState began = world.Timeline(body, world.SimulatedTo)[^1].State; // the step's length follows from what pulled there
                double pull = Math.Max(Gravity, drawn.AccelerationAt(mass, state.Position, state.Velocity, state.Spin).Length);
                double pulled = Math.Max(Gravity, drawn.AccelerationAt(mass, began.Position, began.Velocity, began.Spin).Length);
                slack += drawn.Slack(mass, state, pull, Math.Min(pull, pulled));
                slack += 1e-6 * ((mass * Gravity * state.Position.Length) + drawn.PotentialAt(mass, state.Position));
            }
        }

        return (SceneEnergy.Of(world, world.SimulatedTo), slack);
    }

    private enum Medium
    {
        LinearDrag,
        QuadraticDrag,
        StackedDrag, // a throw down onto a ball with quadratic drag, at high rates
        Spring,
        Damper,
        Magnetic,
        Magnus,
        Pull,
        Supplied,
    }

    /// <summary>A drawn world and what a player does in it.</summary>
    private readonly record struct Drawn
    {
        private readonly Medium kind;
        private readonly Force force;
        private readonly double rate;

        internal Drawn(Random random, Medium kind)
        {
            this.kind = kind;
            Mass = Log(random, 1e-6, 1e6);
            Tolerance = Log(random, 1e-4, 1e-2);
            double speed = Log(random, 0.1, 1000), friction = random.Next(2) * random.NextDouble();
            rate = Log(random, kind is Medium.StackedDrag ? FastForASlowStep : 1, kind switch
            {
                Medium.QuadraticDrag or Medium.StackedDrag or Medium.Supplied => Fastest,
                Medium.Pull => 100, // stronger, it holds everything in its centre
                _ => Permitted,
            });
            Vector3D anchor = V(Between(random, -1, 1), Between(random, 0.1, 1.1), Between(random, -1, 1));
            Velocity = Direction(random) * speed;
            Velocity = kind is Medium.StackedDrag && Velocity.Y > 0 ? -Velocity : Velocity;
            force = kind switch
            {
                Medium.LinearDrag => Force.LinearDrag("oil", rate * Mass),
                Medium.QuadraticDrag or Medium.StackedDrag => Force.QuadraticDrag("air", rate * Mass / (2 * speed)),
                Medium.Spring => Force.Spring("spring", anchor, rate * rate * Mass),
                Medium.Damper => Force.Spring("damper", anchor, 1e-3 * Mass, rate * Mass),
                Medium.Magnetic => Force.Magnetic("coil", Direction(random), rate * Mass),
                Medium.Magnus => Force.Magnus("swerve", rate * Mass / 100),
                Medium.Pull => Force.Central("pull", anchor, rate * rate, 1),
                _ => Force.Supplied(new Thick(rate, Between(random, -1, 1))),
            };
            BodySpec spec = new(Radius, Mass, random.Next(3) == 0 ? 0 : Between(random, 0, 0.95), forces: ForceSet.Of(0), friction: friction);
            SceneBuilder builder = new SceneBuilder("entry").WithContactTolerance(Tolerance).WithSmallestRadius(Radius).AddForce(force)
                .AddPlane("floor", Vector3D.Up, Vector3D.Zero, friction: friction).AddBody("a", spec, V(0, Radius));
            int bodies = kind is Medium.StackedDrag ? 2 : 1 + random.Next(3);
            double ratio = random.Next(2) == 0 ? 1 : Log(random, 1, 1000);
            BodySpec other = new(Radius, Mass * ratio, spec.Restitution, forces: random.Next(4) == 0 ? default : spec.Forces, friction: friction);
            builder = bodies > 1 ? builder.AddBody("b", other, V(0, 3 * Radius)) : builder;
            Scene = (bodies > 2 ? builder.AddBody("c", other, V(2.1 * Radius, Radius)) : builder).Build();
            double at = Between(random, 0.02, random.Next(2) == 0 ? 0.3 : 1.2); // awake, and mostly asleep
            At = SimTime.FromSeconds(random.Next(3) == 0 ? Math.Round(at * 64) / 64 : at);
            BodyId body = BodyId.OfScene(kind is Medium.StackedDrag ? 1 : random.Next(bodies));
            Act = (kind is Medium.StackedDrag ? 0 : random.Next(4)) switch
            {
                0 => PlayerAction.SetVelocity(body, Velocity),
                1 => PlayerAction.Impulse(body, Velocity * Scene.Bodies[body.Index].Spec.Mass),
                2 => PlayerAction.Teleport(body, V(0.5, Radius, 0.5), Velocity),
                _ => PlayerAction.Spawn(spec, V(0.7, Radius, 0.7), Velocity),
            };
        }

        internal double Mass { get; }

        internal double Tolerance { get; }

        internal Vector3D Velocity { get; }

        internal Scene Scene { get; }

        internal SimTime At { get; }

        internal PlayerAction Act { get; }

        internal Vector3D AccelerationAt(double mass, in Vector3D place, in Vector3D velocity, in Vector3D spin = default) =>
            V(0, -Gravity) + force.At(mass, 0, place, velocity, spin);

        /// <summary>What a force keeps at a place, in J: what roundings of it are of.</summary>
        internal double PotentialAt(double mass, in Vector3D place) =>
            (kind is Medium.Spring ? Mass : kind is Medium.Pull ? mass : 0) * 0.5 * rate * rate * (place - force.Vector).LengthSquared;

        /// <summary>What the kinetic energy read within a step may be off by, in J.</summary>
        /// <param name="mass">Of the body, in kg.</param>
        /// <param name="state">As it was read.</param>
        /// <param name="pull">What pulls it there, in m/s².</param>
        /// <param name="weakest">What pulled it least in the step.</param>
        internal double Slack(double mass, in BodyState state, double pull, double weakest)
        {
            double speed = state.Velocity.Length;
            double here = kind switch
            {
                Medium.QuadraticDrag or Medium.StackedDrag => rate * speed / Velocity.Length,
                Medium.Magnus => rate / 100 * state.Spin.Length,
                Medium.Supplied => (AccelerationAt(mass, state.Position, V(1)) - AccelerationAt(mass, state.Position, default)).Length,
                _ => rate,
            };
            here *= kind is Medium.Supplied or Medium.Pull ? 1 : Mass / mass;
            double step = Math.Max(ShortestStep, Math.Min(Math.Min(Math.Sqrt(2 * Tolerance / weakest), LongestStep), 1 / (StepsOfARate * here)));
            double off = 0.5 * pull * step;
            return mass * ((speed * off) + (0.5 * off * off) + (1e-6 * speed * speed));
        }

        private static Vector3D Direction(Random random)
        {
            double turn = Between(random, 0, 2 * Math.PI), rise = Between(random, -1.5, 1.5);
            return V(Math.Cos(rise) * Math.Cos(turn), Math.Sin(rise), Math.Cos(rise) * Math.Sin(turn));
        }

        private static double Between(Random random, double least, double most) => least + ((most - least) * random.NextDouble());

        private static double Log(Random random, double least, double most) => Math.Exp(Between(random, Math.Log(least), Math.Log(most)));
    }

    /// <summary>A medium that a program brings, thin up to a plane and thick from 5 cm beyond it on.</summary>
    private sealed class Thick(double rate, double from) : IAcceleration
    {
        public string Name => "thick";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => velocity * (-0.1 - (rate * Math.Clamp((position.X - from) / 0.05, 0, 1)));
    }
}
