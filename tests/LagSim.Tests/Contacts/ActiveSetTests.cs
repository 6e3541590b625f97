using System;
using System.Collections.Generic;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>
/// Few contacts are solved exactly: every demand that can be met is met, by pushes alone, and what pushes opens just as fast as is demanded.
/// </summary>
public sealed class ActiveSetTests
{
    private const double Near = 1e-9;

    /// <summary>
    /// Contacts on one line demand differences of velocities. Those can be met unless a cycle of them demands more than nothing, which
    /// the shortest paths of Bellman and Ford decide. Many of these contacts are combinations of others.
    /// </summary>
    [Fact]
    public void TrySolve_ContactsOnALine_MeetsWhatCanBeMet()
    {
        Random random = new(20261130);
        int met = 0, unmet = 0;
        for (int n = 0; n < 3000; n++)
        {
            int bodies = 2 + random.Next(5);
            double[] masses = new double[bodies];
            for (int b = 0; b < bodies; b++)
            {
                masses[b] = Math.Pow(10, (4 * random.NextDouble()) - 2);
            }

            List<ContactPoint> contacts = [];
            List<double> demands = [];
            for (int c = 0; c < 2 + random.Next(8); c++)
            {
                int first = random.Next(bodies), second = random.Next(bodies + 1) - 1;
                if (second != first)
                {
                    double sign = random.Next(4) == 0 || first < second ? -1 : 1; // mostly one above another
                    contacts.Add(new ContactPoint(first, second < 0 ? ContactPoint.Static : second, second < 0 ? 0 : -1, default) { Normal = V(0, sign) });
                    demands.Add(random.Next(3) == 0 ? 0 : (3 * random.NextDouble()) - 1);
                }
            }

            bool isMet = Solve([.. contacts], masses, [.. demands]);
            Assert.Equal(CanBeMet(bodies, contacts, demands), isMet);
            met += isMet ? 1 : 0;
            unmet += isMet ? 0 : 1;
        }

        Assert.True(met > 200 && unmet > 200, $"{met} {unmet}");
    }

    /// <summary>
    /// Three balls at one point, two of which just touch a fourth below them: the contact of the outer two is a combination of those that are
    /// met first, and demands more than they do.
    /// </summary>
    [Fact]
    public void TrySolve_ACombinationThatDemandsMore_TakesThePlaceOfOne()
    {
        Vector3D up = Vector3D.Up;
        ContactPoint[] contacts =
        [
            new(0, ContactPoint.Static, 0, default) { Normal = up }, new(0, 1, -1, default) { Normal = -up }, new(0, 3, -1, default) { Normal = -up },
            new(1, 2, -1, default) { Normal = up }, new(1, 3, -1, default) { Normal = up }, new(2, 3, -1, default) { Normal = up },
        ];
        Assert.True(Solve(contacts, [1, 5, 4, 1], [0.08, 0, 0, 2.8745, 3.5048, 2.8745]));
    }

    /// <summary>The control: a ball between floor and ceiling cannot leave both.</summary>
    [Theory]
    [InlineData(0.1, false)]
    [InlineData(-0.1, true)]
    public void TrySolve_ABallBetweenFloorAndCeiling_IsToldWhetherItCan(double fromCeiling, bool isMet)
    {
        ContactPoint[] contacts =
        [
            new(0, ContactPoint.Static, 0, default) { Normal = Vector3D.Up }, new(0, ContactPoint.Static, 1, default) { Normal = -Vector3D.Up },
        ];
        Assert.Equal(isMet, Solve(contacts, [1], [0.1, fromCeiling]));
    }

    /// <summary>Solves, and checks all that a solution is: pushes alone, of the change that they make, exact where they push.</summary>
    private static bool Solve(ContactPoint[] contacts, double[] masses, double[] demands)
    {
        double[] impulses = new double[contacts.Length];
        Vector3D[] changes = new Vector3D[masses.Length];
        bool isMet = new ActiveSet().TrySolve(contacts, masses, demands, impulses, changes);
        Vector3D[] given = new Vector3D[masses.Length];
        for (int i = 0; i < contacts.Length && isMet; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            double opens = ImpactSolver.Opening(c, changes);
            Assert.InRange(opens, demands[i] - Near, impulses[i] > Near ? demands[i] + Near : double.PositiveInfinity);
            Assert.True(impulses[i] >= 0);
            given[c.First] += c.Normal * impulses[i];
            if (c.Second != ContactPoint.Static)
            {
                given[c.Second] -= c.Normal * impulses[i];
            }
        }

        for (int b = 0; b < masses.Length && isMet; b++)
        {
            Assert.InRange((given[b] - (changes[b] * masses[b])).Length, 0, Near * (1 + given[b].Length));
        }

        return isMet;
    }

    /// <summary>Whether no cycle demands more than nothing: then longest paths end.</summary>
    private static bool CanBeMet(int bodies, List<ContactPoint> contacts, List<double> demands)
    {
        double[] speed = new double[bodies + 1]; // the last is what is static
        for (int pass = 0; pass <= bodies + 1; pass++)
        {
            bool has = false;
            for (int i = 0; i < contacts.Count; i++)
            {
                int above = contacts[i].First, below = contacts[i].Second == ContactPoint.Static ? bodies : contacts[i].Second;
                (above, below) = contacts[i].Normal.Y > 0 ? (above, below) : (below, above);
                if (speed[below] + demands[i] > speed[above] + Near)
                {
                    speed[above] = speed[below] + demands[i];
                    has = true;
                }
            }

            if (!has)
            {
                return true;
            }
        }

        return false;
    }
}
