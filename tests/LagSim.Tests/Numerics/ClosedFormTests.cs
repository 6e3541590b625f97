using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Flight in closed form against the textbook's formulas.</summary>
public sealed class ClosedFormTests
{
    private const double Ulp = 2.220446049250313e-16;

    [Theory]
    [InlineData(0.01)]
    [InlineData(1)]
    [InlineData(50)]
    [InlineData(1e6)]
    public void LinearDrag_Falling_IsTheExponential(double gamma)
    {
        Simulation world = Fly(Force.LinearDrag("oil", 2 * gamma, V(3)), V(1, 2, 3), V(5, 7, -1), 2, out _, gravity: V(0, -9.81), mass: 2);
        foreach (double t in Ticks(0.1, 0.77, 1.5, 2))
        {
            Vector3D terminal = V(3, -9.81 / gamma);
            double left = Math.Exp(-gamma * t), lasting = -Math.Exp(-gamma * t) + 1;
            BodyState state = Read(world, First, t);
            Near(V(1, 2, 3) + (terminal * t) + ((V(5, 7, -1) - terminal) * (lasting / gamma)), state.Position, 1e-9 + (1e-13 * terminal.Length));
            Near(terminal + ((V(5, 7, -1) - terminal) * left), state.Velocity, 1e-6);
        }
    }

    [Theory]
    [InlineData(0)] // undamped
    [InlineData(0.5)]
    [InlineData(6)] // critical
    [InlineData(40)]
    [InlineData(1e5)] // stiff
    public void Spring_WithDamper_IsTheOscillator(double damping)
    {
        Simulation world = Fly(Force.Spring("spring", V(1), 9, damping), V(2), V(0, 0.5), 4, out _, tolerance: 0);
        foreach (double t in Ticks(0.3, 1, 2.2, 4))
        {
            (double kick, double place) = Oscillator(damping, 9, t);
            Near(V(1) + (V(1) * place) + (V(0, 0.5) * kick), Read(world, First, t).Position, 1e-13 * Math.Max(1, damping / 100));
        }
    }

    /// <summary>Let go at rest, where it has no speed to be rounded as, it comes in as few pieces as one that moves, and is as exact.</summary>
    [Fact]
    public void Spring_LetGoAtRest_ToRounding_TakesNoMorePiecesThanOneThatMoves()
    {
        Force spring = Force.Spring("spring", default, 100);
        Simulation still = Fly(spring, V(1), default, 10, out int ofStill, tolerance: 0);
        Fly(spring, V(1), V(10), 10, out int ofMoving, tolerance: 0);
        Assert.InRange(ofStill, 1000, 4 * ofMoving);
        double cos = (1 - Math.Pow(Math.Sin(50), 2)) - Math.Pow(Math.Sin(50), 2);
        Near(V(cos), Read(still, First, 10).Position, 1e-12);
        Near(V(-20 * Math.Sin(50) * Math.Sqrt(1 - Math.Pow(Math.Sin(50), 2))), Read(still, First, 10).Velocity, 1e-11);
    }

    [Theory]
    [InlineData(0, 1e-12)]
    [InlineData(1e-9, 1e-8)]
    public void Magnetic_WithGravity_IsTheCycloid(double tolerance, double allowed)
    {
        // q B / m = 3 along z, gravity along -y: a circle about a centre that drifts along -x with g m / (q B).
        Simulation world = Fly(Force.Magnetic("coil", V(0, 0, 2), 3), V(0), V(1, 0, 0.25), 10, out _, gravity: V(0, -1.5), mass: 2, tolerance: tolerance);
        foreach (double t in Ticks(0.4, 3.3, 10))
        {
            double phase = 3 * t, drift = -1.5 / 3;
            double radial = 1 - drift; // the speed around the moving centre
            Vector3D expected = V((drift * t) + (radial / 3 * Math.Sin(phase)), radial / 3 * (Math.Cos(phase) - 1), 0.25 * t);
            Near(expected, Read(world, First, t).Position, allowed);
        }
    }

    /// <summary>A magnetic field does no work: in a hundred turns the speed changes by rounding alone.</summary>
    [Fact]
    public void Magnetic_HundredTurns_KeepsTheSpeed()
    {
        Simulation world = Fly(Force.Magnetic("coil", V(1, 2, 2), 200 * Math.PI / 3), V(0), V(3, 4), 1, out int pieces, tolerance: 1e-12);
        double drift = Math.Abs(Read(world, First, 1).Velocity.Length - 5) / 5;
        Assert.True(drift <= 4 * Ulp * pieces, $"{drift:R} in {pieces} pieces");

        // The control: the classical method at a hundredth of a turn loses speed that anyone would see.
        Simulation rough = Fly(Force.Magnetic("coil", V(1, 2, 2), 200 * Math.PI / 3), V(0), V(3, 4), 1, out _, law: MotionLaw.RungeKutta4, step: 1e-4);
        Assert.True(Math.Abs(Read(rough, First, 1).Velocity.Length - 5) / 5 > 4 * Ulp * pieces);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.3)]
    [InlineData(0.9)]
    [InlineData(0.999)]
    public void Kepler_OneAndAHalfTurns_IsKeplersEquation(double e)
    {
        // From the far end of an ellipse of half axis 1 about (5, 0, 0), mu = 1: a turn takes 2 pi.
        double speed = Math.Sqrt((1 - e) / (1 + e));
        Simulation world = Fly(Force.Central("sun", V(5), 1), V(5 + 1 + e), V(0, 0, speed), 9, out int pieces, tolerance: 0);
        foreach (double t in Ticks(0.5, 2, 3.1, 3.2, 6, 9))
        {
            double mean = t + Math.PI, anomaly = mean;
            for (int i = 0; i < 100; i++)
            {
                anomaly -= (anomaly - (e * Math.Sin(anomaly)) - mean) / (1 - (e * Math.Cos(anomaly)));
            }

            // The phase is as good as the sum of the pieces' roundings, and what the rounding of coordinates of size 6 makes of the energy where the pull is
            // strongest, as often as there are pieces, at random; how far that moves the body goes with its speed.
            double nearest = 1 - e;
            double phase = (16 * Ulp * pieces) + (6 * Ulp / (nearest * nearest) * 3 * t * Math.Sqrt(pieces));
            Vector3D expected = V(5 - (Math.Cos(anomaly) - e), 0, -Math.Sqrt(1 - (e * e)) * Math.Sin(anomaly));
            BodyState state = Read(world, First, t);
            Near(expected, state.Position, phase * (1 + state.Velocity.Length));
        }
    }

    [Fact]
    public void Kepler_IntoTheCentre_LeavesTheWorld()
    {
        LostBody lost = Assert.Single(Fly(Force.Central("sun", V(0), 1), V(1), V(0), 3, out _).LostBodies());
        Assert.Equal(LossReason.TooStiff, lost.Reason);
        Near(Math.PI / Math.Sqrt(8), lost.Time.ToSeconds(), 1e-6); // a fall from 1 m takes so long
        Assert.Empty(Fly(Force.Central("sun", V(0), 1), V(1), V(0, 0, 0.5), 3, out _).LostBodies()); // the control: past it
    }

    [Fact]
    public void Automatic_PicksTheCheapestExactLaw()
    {
        Assert.Equal(MotionLaw.Ballistic, Law(new SceneBuilder("none")));
        Assert.Equal(MotionLaw.ClosedForm, Law(new SceneBuilder("oil"), Force.LinearDrag("oil", 1), Force.Spring("spring", V(1), 1)));
        Assert.Equal(MotionLaw.ClosedForm, Law(new SceneBuilder("sun").WithGravity(default), Force.Central("sun", V(50), 1)));
        Assert.Equal(MotionLaw.DormandPrince54, Law(new SceneBuilder("sun on earth"), Force.Central("sun", V(50), 1)));
        Assert.Equal(MotionLaw.DormandPrince54, Law(new SceneBuilder("antisun").WithGravity(default), Force.Central("sun", V(50), -1)));
        Assert.Equal(MotionLaw.DormandPrince54, Law(new SceneBuilder("air"), Force.QuadraticDrag("air", 1)));
        Assert.Equal(MotionLaw.DormandPrince54, Law(new SceneBuilder("own"), Force.LinearDrag("oil", 1), Force.Supplied(new FunctionForce((_, _, v) => -v))));
    }

    /// <summary>Bounces in closed form: hop by hop from one exact impact to the next.</summary>
    [Fact]
    public void LinearDrag_Bouncing_MatchesHopByHop()
    {
        const double gamma = 0.5, g = 9.81, e = 0.8;
        Simulation world = new(
            new SceneBuilder("bouncing").AddForce(Force.LinearDrag("oil", gamma), out ForceSet oil).AddPlane("floor", Vector3D.Up, V(0))
                .AddBody("ball", new BodySpec(0.5, 1, e, forces: oil, tolerance: 0), V(0, 2.5)).Build(),
            KeepAll);
        world.AdvanceTo(At(4));
        double[] times = Impacts(world, First).Select(impact => impact.Key.Time.SecondsSince(default)).Take(5).ToArray();
        double height = 2, up = 0, at = 0;
        foreach (double time in times)
        {
            double next = 0;
            for (double low = up > 0 ? 1e-3 : 0, high = 3, i = 0; i < 200; i++)
            {
                next = (low + high) / 2;
                double y = height - (g / gamma * next) + ((up + (g / gamma)) * (1 - Math.Exp(-gamma * next)) / gamma);
                (low, high) = y > 0 ? (next, high) : (low, next);
            }

            at += next;
            up = -e * ((-g / gamma) + ((up + (g / gamma)) * Math.Exp(-gamma * next)));
            height = 0;
            Near(at, time, 1e-12);
        }

        Assert.Equal(5, times.Length);
    }

    /// <summary>Instants there are, nearest to those: a formula asked for any other is off by as much as the body moves in between.</summary>
    private static double[] Ticks(params double[] seconds) => seconds.Select(t => At(t).SecondsSince(default)).ToArray();

    private static MotionLaw Law(SceneBuilder builder, params Force[] forces)
    {
        ForceSet all = default;
        foreach (Force force in forces)
        {
            builder.AddForce(force, out ForceSet itself);
            all |= itself;
        }

        return builder.AddBody("ball", new BodySpec(0.5, 1, 1, forces: all), V(0)).Build().Bodies[0].Spec.Flight;
    }

    /// <summary>What a velocity of 1 and a place of 1 become of x'' = -damping x' - stiffness x.</summary>
    private static (double Kick, double Place) Oscillator(double damping, double stiffness, double t)
    {
        double half = damping / 2, root = (half * half) - stiffness;
        if (root == 0)
        {
            return (t * Math.Exp(-half * t), (1 + (half * t)) * Math.Exp(-half * t));
        }

        if (root < 0)
        {
            double omega = Math.Sqrt(-root);
            double sine = Math.Sin(omega * t) / omega;
            return (Math.Exp(-half * t) * sine, Math.Exp(-half * t) * (Math.Cos(omega * t) + (half * sine)));
        }

        double slow = -stiffness / (half + Math.Sqrt(root)), fast = -half - Math.Sqrt(root);
        return ((Math.Exp(slow * t) - Math.Exp(fast * t)) / (slow - fast), ((slow * Math.Exp(fast * t)) - (fast * Math.Exp(slow * t))) / (slow - fast));
    }

    private static Simulation Fly(
        Force force,
        in Vector3D position,
        in Vector3D velocity,
        double seconds,
        out int pieces,
        Vector3D gravity = default,
        double mass = 1,
        double tolerance = BodySpec.DefaultTolerance,
        MotionLaw law = MotionLaw.Automatic,
        double step = 0)
    {
        BodySpec spec = new(0.1, mass, 1, law, step == 0 ? null : SimDuration.FromSeconds(step), ForceSet.Of(0), tolerance);
        Simulation world = new(new SceneBuilder("flight").WithGravity(gravity).AddForce(force).AddBody("ball", spec, position, velocity).Build(), KeepAll);
        world.AdvanceTo(At(seconds));
        pieces = world.Timeline(First).Count;
        return world;
    }
}
