using System;
using System.Collections.Generic;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Contacts of large heaps, solved by projected gradients; and what a solver makes of the same contacts again.</summary>
public sealed class ProjectedGradientsTests
{
    [Theory]
    [InlineData(3)]
    [InlineData(NormalImpulses.LikeMasses)]
    public void Solve_LayersOfBalls_NoneClosesAndNoEnergyIsGained(double ratio)
    {
        for (int seed = 0; seed < 20; seed++)
        {
            (double closing, double gain) = Settle(seed, (c, m, v) => new ImpactSolver().Solve(c, m, v), ratio);
            Assert.True(closing < 1e-11 && gain <= 1e-12, $"seed {seed}: closing {closing} m/s, {gain} J more");
        }
    }

    /// <summary>Twenty balls, each between two walls that it is to leave both at once: that cannot be, is said not to be, and they stop.</summary>
    [Fact]
    public void Solve_ManyThatCannotOpen_Stop()
    {
        List<ContactPoint> contacts = [];
        double[] masses = new double[20];
        Vector3D[] velocities = new Vector3D[20];
        for (int b = 0; b < masses.Length; b++)
        {
            masses[b] = 1 + b;
            velocities[b] = V(b % 2 == 0 ? 1 : -1, 0.5);
            contacts.Add(new ContactPoint(b, ContactPoint.Static, 0, default) { Normal = V(1), Target = 1 });
            contacts.Add(new ContactPoint(b, ContactPoint.Static, 1, default) { Normal = V(-1), Target = 1 });
        }

        ContactPoint[] all = [.. contacts];
        Assert.True(all.Length > NormalImpulses.FewAtOnce);
        Assert.False(ByGradients(all, masses, [.. velocities]));
        new ImpactSolver().Solve(all, masses, velocities);
        Assert.All(velocities, v => Near(V(0, 0.5), v, 1e-12));
    }

    [Fact]
    public void Check_OneStepOrTwiceTheSpeed_IsSeenToFail()
    {
        Assert.True(Settle(0, (c, m, v) => ByGradients(c, m, v, steps: 1)).Closing > 0.1);
        Assert.True(Settle(0, (c, m, v) => ByGradients(c, m, v), ratio: 1e6).Closing > 0.1); // why there is a largest ratio
        Assert.True(Settle(0, (c, m, v) =>
        {
            for (int i = 0; i < c.Length; i++)
            {
                c[i].Target = 2 * Math.Max(0, -ImpactSolver.Opening(c[i], v)); // parts at twice the speed
            }

            ByGradients(c, m, v);
        }).Gain > 1e-3);
    }

    /// <summary>What many contacts end with is what the exact solver makes of them, and what few do.</summary>
    [Theory]
    [InlineData(3, 1e-11)]
    [InlineData(4, 1e-11)]
    public void Solve_FewContacts_IsWhatIsSolvedExactly(int side, double within)
    {
        for (int seed = 0; seed < 50; seed++)
        {
            (ContactPoint[] contacts, double[] masses, Vector3D[] exact) = Layers(seed, side);
            Vector3D[] velocities = [.. exact];
            Assert.True(contacts.Length <= NormalImpulses.FewAtOnce);
            new ImpactSolver().Solve(contacts, masses, exact);
            Assert.True(ByGradients(contacts, masses, velocities));
            for (int b = 0; b < exact.Length; b++)
            {
                Near(exact[b], velocities[b], within);
            }
        }
    }

    private delegate void Solver(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities);

    private static bool ByGradients(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, int steps = ProjectedGradients.MaxSteps)
    {
        double[] demand = new double[contacts.Length];
        for (int i = 0; i < demand.Length; i++)
        {
            demand[i] = contacts[i].Target - ImpactSolver.Opening(contacts[i], velocities);
        }

        Vector3D[] change = new Vector3D[velocities.Length];
        double[] impulse = new double[demand.Length];
        bool isMet = new ProjectedGradients().TrySolve(contacts, masses, demand, impulse, change, again: false, steps: steps);
        for (int b = 0; b < change.Length; b++)
        {
            velocities[b] += change[b];
        }

        return isMet;
    }

    /// <summary>How fast any contact still closes, and how much more energy there is.</summary>
    private static (double Closing, double Gain) Settle(int seed, Solver solve, double ratio = 3)
    {
        (ContactPoint[] contacts, double[] masses, Vector3D[] velocities) = Layers(seed, 8, ratio);
        Assert.True(contacts.Length > NormalImpulses.MaxAtOnce);
        double before = Energy(masses, velocities), closing = 0;
        solve(contacts, masses, velocities);
        foreach (ContactPoint c in contacts)
        {
            closing = Math.Max(closing, -ImpactSolver.Opening(c, velocities));
        }

        return (closing, Energy(masses, velocities) - before);
    }

    private static double Energy(double[] masses, Vector3D[] velocities)
    {
        double sum = 0;
        for (int b = 0; b < masses.Length; b++)
        {
            sum += 0.5 * masses[b] * velocities[b].LengthSquared;
        }

        return sum;
    }

    /// <summary>A square of balls that touch their neighbours, the lowest a floor, with any velocities; nothing bounces.</summary>
    private static (ContactPoint[] Contacts, double[] Masses, Vector3D[] Velocities) Layers(int seed, int side, double ratio = 3)
    {
        Random random = new(seed);
        List<ContactPoint> contacts = [];
        double[] masses = new double[side * side];
        Vector3D[] velocities = new Vector3D[side * side];
        Random shape = new(side); // the same for every seed
        for (int b = 0; b < masses.Length; b++)
        {
            masses[b] = Math.Exp(shape.NextDouble() * Math.Log(ratio));
            velocities[b] = V(random.NextDouble() - 0.5, -random.NextDouble());
            if (b < side)
            {
                contacts.Add(new ContactPoint(b, ContactPoint.Static, 0, default) { Normal = V(0, 1) });
            }
            else
            {
                contacts.Add(new ContactPoint(b - side, b, -1, default) { Normal = V(0, -1) });
            }

            if (b % side > 0)
            {
                contacts.Add(new ContactPoint(b - 1, b, -1, default) { Normal = V(-1) });
            }
        }

        return ([.. contacts], masses, velocities);
    }
}
