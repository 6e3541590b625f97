using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>All contacts of one impact together: what the law demands, for any bodies and any normals.</summary>
public sealed class ImpactSolverTests
{
    private delegate void Solver(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities);

    private static Config Many => Config.QuickThrowOnFailure.WithMaxTest(3000).WithReplay(20261121, 1);

    /// <summary>Up to six bodies and seven contacts, all closing or still, with a restitution each, masses up to six decades apart.</summary>
    private static readonly Arbitrary<Impact> Impacts = (
        from seed in Gen.Choose(0, int.MaxValue)
        select Impact.Random(new Random(seed))).ToArbitrary();

    [Fact]
    public void Solve_AnyImpact_SeparatesEveryContactAndGainsNoEnergy()
    {
        Check((contacts, masses, velocities) => new ImpactSolver().Solve(contacts, masses, velocities));
    }

    [Fact]
    public void Check_ContactsOneAfterAnother_IsSeenToFail()
    {
        // Each contact solved alone, in turn, undoes the one before it.
        Assert.ThrowsAny<Exception>(() => Check((contacts, masses, velocities) =>
        {
            foreach (ContactPoint contact in contacts)
            {
                new ImpactSolver().Solve([contact], masses, velocities);
            }
        }));
    }

    [Fact]
    public void Check_RestitutionAboveOne_IsSeenToFail()
    {
        Assert.ThrowsAny<Exception>(() => Check((contacts, masses, velocities) =>
        {
            ContactPoint[] livelier = contacts.ToArray();
            for (int i = 0; i < livelier.Length; i++)
            {
                livelier[i].Target *= 1.5;
            }

            new ImpactSolver().Solve(livelier, masses, velocities);
        }));
    }

    [Fact]
    public void Solve_SameSolverUsedAgain_GivesTheSameBits()
    {
        ImpactSolver used = new();
        Prop.ForAll(Impacts, impact =>
        {
            Vector3D[] a = (Vector3D[])impact.Velocities.Clone(), b = (Vector3D[])impact.Velocities.Clone();
            used.Solve(impact.Contacts, impact.Masses, a);
            new ImpactSolver().Solve(impact.Contacts, impact.Masses, b);
            return a.SequenceEqual(b);
        }).Check(Many);
    }

    [Fact]
    public void Solve_ContactsInAnotherOrder_GivesTheSamePhysics()
    {
        Prop.ForAll(Impacts, impact =>
        {
            Vector3D[] a = (Vector3D[])impact.Velocities.Clone(), b = (Vector3D[])impact.Velocities.Clone();
            new ImpactSolver().Solve(impact.Contacts, impact.Masses, a);
            new ImpactSolver().Solve(impact.Contacts.Reverse().ToArray(), impact.Masses, b);
            return a.Zip(b, (x, y) => (x - y).Length).Max() <= 1e-6 * impact.Scale;
        }).Check(Many);
    }

    [Fact]
    public void Solve_JammedBetweenWallsThatCannotGiveWay_ComesToRestBetweenThem()
    {
        ContactPoint left = new(0, ContactPoint.Static, 0, default) { Normal = V(1), Target = 1 };
        ContactPoint right = new(0, ContactPoint.Static, 1, default) { Normal = V(-1), Target = 1 };
        Vector3D[] velocities = [V(0.25, 3)];
        new ImpactSolver().Solve([left, right], [1], velocities);
        Assert.Equal(V(0, 3), velocities[0]);
    }

    /// <summary>A milligram between the floor, a wall and a dome, and a ton above it: what holds the ton is a hundred-millionth of what the milligram's row weighs.</summary>
    [Theory]
    [InlineData(1e-6, 1e3)]
    [InlineData(1e-3, 1e3)]
    [InlineData(1, 1)]
    public void Solve_LightBodyWedgedUnderAHeavyOne_IsNotLeftClosing(double light, double heavy)
    {
        ContactPoint[] contacts =
        [
            new(0, ContactPoint.Static, 0, default) { Normal = V(0, 1) },
            new(0, ContactPoint.Static, 3, default) { Normal = V(0, 0, 1) },
            new(0, ContactPoint.Static, 5, default) { Normal = Unit(V(0.52, 0.6, -0.61)) },
            new(0, 1, -1, default) { Normal = Unit(V(-0.06, -0.67, -0.74)) },
            new(1, ContactPoint.Static, 2, default) { Normal = V(-1) },
        ];
        Vector3D[] velocities = [V(-1800, -2000, -1500), V(0.01, -0.02, -0.01)];
        new ImpactSolver().Solve(contacts, [light, heavy], velocities);
        Assert.All(contacts, c => Assert.InRange(ImpactSolver.Opening(c, velocities), -1e-9, double.MaxValue)); // some 4,000 ulps of the largest speed
    }

    [Fact]
    public void Solve_NewtonsCradle_PassesTheBlowToTheLastBall()
    {
        // As it happens in the world: the contacts close one after another, round by round.
        Scene scene = new SceneBuilder("cradle").WithGravity(Floating)
            .AddBody("a", Ball(), V(-2), V(1)).AddBody("b", Ball(), V(0)).AddBody("c", Ball(), V(1)).AddBody("d", Ball(), V(2)).Build();
        Simulation simulation = Run(scene, 3);
        Assert.Equal([0.0, 0, 0, 1], Bodies(simulation).Select(body => Read(simulation, body, 3).Velocity.X));
    }

    private static Vector3D Unit(Vector3D v) => v / v.Length;

    private static void Check(Solver solve) => Prop.ForAll(Impacts, impact =>
    {
        Vector3D[] after = (Vector3D[])impact.Velocities.Clone();
        solve(impact.Contacts, impact.Masses, after);
        double slack = 1e-9 * impact.Scale;
        bool separates = impact.Contacts.All(c => ImpactSolver.Opening(c, after) >= -slack);
        bool staysFinite = after.All(v => v.IsFinite);
        double before = impact.Energy(impact.Velocities), now = impact.Energy(after);
        bool momentum = impact.Contacts.Any(c => c.Second == ContactPoint.Static)
            || (impact.Momentum(impact.Velocities) - impact.Momentum(after)).Length <= 1e-9 * impact.Masses.Max() * impact.Scale;
        return staysFinite.Label("finite").And(separates.Label("still closing")).And((now <= before * (1 + 1e-9)).Label($"energy {before:R} -> {now:R}"))
            .And(momentum.Label("momentum"));
    }).Check(Many);

    private sealed record Impact(ContactPoint[] Contacts, double[] Masses, Vector3D[] Velocities)
    {
        internal double Scale => Velocities.Max(v => v.Length) + 1e-300;

        internal static Impact Random(Random random)
        {
            int bodies = random.Next(1, 7);
            double[] masses = Enumerable.Range(0, bodies).Select(_ => Math.Pow(10, random.Next(-3, 4))).ToArray();
            Vector3D[] velocities = Enumerable.Range(0, bodies).Select(_ => Direction(random) * random.Next(0, 4)).ToArray();
            ContactPoint[] contacts = new ContactPoint[random.Next(1, 8)];
            for (int i = 0; i < contacts.Length; i++)
            {
                int first = random.Next(bodies), second = random.Next(bodies);
                contacts[i] = new ContactPoint(
                    Math.Min(first, second), first == second ? ContactPoint.Static : Math.Max(first, second), first == second ? i : -1, default)
                {
                    Normal = Direction(random),
                };
                double closing = -ImpactSolver.Opening(contacts[i], velocities);
                if (closing < 0)
                {
                    contacts[i].Normal = -contacts[i].Normal; // only what closes takes part in an impact
                    closing = -closing;
                }

                contacts[i].Target = closing * random.Next(0, 5) / 4.0;
            }

            return new Impact(contacts, masses, velocities);
        }

        internal double Energy(Vector3D[] velocities) => velocities.Zip(Masses, (v, m) => 0.5 * m * v.LengthSquared).Sum();

        internal Vector3D Momentum(Vector3D[] velocities) => velocities.Zip(Masses, (v, m) => v * m).Aggregate(Vector3D.Zero, (a, b) => a + b);

        private static Vector3D Direction(Random random)
        {
            while (true)
            {
                Vector3D v = V((random.NextDouble() * 2) - 1, (random.NextDouble() * 2) - 1, (random.NextDouble() * 2) - 1);
                if (v.Length is > 0.1 and < 1)
                {
                    return v / v.Length;
                }
            }
        }
    }
}
