using System;
using System.Collections.Generic;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

/// <summary>Which two of many balls overlap, against a look at all pairs.</summary>
public sealed class OverlapSearchTests
{
    [Theory]
    [InlineData(1, 400, false, false)]
    [InlineData(2, 400, true, false)]
    [InlineData(3, 400, false, true)]
    [InlineData(4, 400, true, true)]
    public void Find_BallsThatAreAddedOneByOne_FindsTheFirstThatOverlapsAndNoneBefore(int seed, int most, bool boxed, bool allSizes)
    {
        // Space fills up until one fits no more; whoever is the first to overlap is what a look at all pairs says.
        Random random = new(seed);
        PeriodicBox box = boxed ? new SceneBuilder("box").WithGravity(V(0)).WithPeriodicBox(V(20, 18, 16)).Build().Box : default;
        int found = 0;
        for (int round = 0; round < 12; round++)
        {
            List<SceneBody> bodies = new();
            for (int n = 0; n < most; n++)
            {
                double radius = allSizes ? 0.01 * Math.Pow(100, random.NextDouble()) : 0.25;
                Vector3D place = V(20 * random.NextDouble(), 18 * random.NextDouble(), 16 * random.NextDouble());
                SceneBody body = new($"ball {n}", new BodySpec(radius, 1, 1), place, V(0), PeerSet.Everyone, V(0));
                int overlapped = bodies.FindIndex(b => box.Nearest(b.Position - place).Length < b.Spec.Radius + radius - 1e-9);
                if (overlapped >= 0 && random.Next(round < 6 ? 1000 : 10) > 0)
                {
                    continue;
                }

                bodies.Add(body);
                Overlap? overlap = overlapped >= 0 || n % 100 == 99 ? new OverlapSearch(bodies.ToArray(), box, 1e-9).Find() : null;
                Assert.Equal(overlapped >= 0, overlap is not null);
                if (overlap is { First: int first, Second: int second, Depth: double depth })
                {
                    double gap = box.Nearest(bodies[first].Position - bodies[second].Position).Length - bodies[first].Spec.Radius - bodies[second].Spec.Radius;
                    Assert.Equal((-gap, bodies.Count - 1), (depth, second)); // only the last overlaps anybody
                    found++;
                    break;
                }
            }
        }

        Assert.InRange(found, 1, 11);
    }
}
