using System;
using System.Linq;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

/// <summary>The nearest place outside of planes and static spheres, against Dykstra's projections (Boyle and Dykstra 1986), which converge on it slowly.</summary>
public sealed class NearestPlaceTests
{
    private const double Radius = 0.25;

    /// <summary>The control takes one projection after the other, which ends outside, but not at the nearest place.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Place_AmongDrawnPlanes_IsTheNearest(bool corrects)
    {
        int differing = 0, found = 0;
        for (int seed = 0; seed < 400; seed++)
        {
            Random random = new(seed);
            Vector3D within = 3 * Direction(random); // so that there is a place outside of all
            StaticPlane[] planes = [.. Enumerable.Range(0, 1 + random.Next(8)).Select(_ =>
            {
                Vector3D normal = Direction(random);
                return new StaticPlane("wall", normal, Vector3D.Dot(normal, within) - Radius - random.NextDouble(), 0, 0);
            })];
            Vector3D from = 2 * Direction(random);
            StaticSurfaces surfaces = new(planes, []);
            if (!new NearestPlace(surfaces).TryFind(from, Radius, default, out Vector3D place))
            {
                continue;
            }

            found++;
            Assert.All(planes, plane => Assert.True(plane.Gap(place, Radius) > -1e-11, $"{seed}: {plane.Gap(place, Radius)}"));
            differing += (place - Projected(planes, from, corrects)).Length > 1e-5 ? 1 : 0;
        }

        Assert.True(found > 395, $"{found}");
        Assert.Equal(corrects, differing == 0);
    }

    /// <summary>In a cone of four planes, narrow or wide, there is a place at the tip or along an edge: none is said to lack one.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(0.5)]
    [InlineData(0.1)]
    [InlineData(0.01)]
    public void Place_InADrawnConeOfFourPlanes_IsOutsideOfAll(double spread)
    {
        for (int seed = 0; seed < 2000; seed++)
        {
            Random random = new(seed);
            StaticPlane[] cone = [.. Enumerable.Range(0, 4).Select(_ => new StaticPlane("side", (Vector3D.Up + (spread * Direction(random))).Direction, 0, 0, 0))];
            Vector3D from = Direction(random);
            Assert.True(new NearestPlace(new StaticSurfaces(cone, [])).TryFind(from, Radius, default, out Vector3D place), $"{seed}");
            Assert.All(cone, plane => Assert.True(plane.Gap(place, Radius) > -1e-13 * (1 + place.Length), $"{seed}: {plane.Gap(place, Radius)}"));
            Vector3D above = from + (Vector3D.Up * cone.Max(plane => -plane.Gap(from, Radius) / plane.Normal.Y)); // straight up: outside too, and no nearer
            Assert.True((place - from).Length <= (above - from).Length + 1e-12, $"{seed}");
        }
    }

    /// <summary>Beside one static sphere it is the nearest, and among several it is outside.</summary>
    [Fact]
    public void Place_AmongDrawnSpheresOnAFloor_IsOutside()
    {
        int found = 0;
        for (int seed = 0; seed < 400; seed++)
        {
            Random random = new(seed);
            StaticSphere[] spheres = [.. Enumerable.Range(0, 1 + random.Next(3)).Select(_ => new StaticSphere("rock", Direction(random) * 1.5, 0.3 + random.NextDouble(), 0, 0))];
            Vector3D from = Direction(random) + spheres[0].Centre;
            StaticSurfaces surfaces = new([new StaticPlane("floor", Vector3D.Up, -1, 0, 0)], spheres);
            NearestPlace nearest = new(surfaces);
            if (nearest.TryFind(from, Radius, default, out Vector3D place))
            {
                found++;
                Assert.All(Enumerable.Range(0, surfaces.Count), surface => Assert.True(surfaces.Gap(surface, place, Radius) > -1e-12));
            }

            Assert.True(new NearestPlace(new StaticSurfaces([], [spheres[0]])).TryFind(from, Radius, default, out place));
            double reach = Math.Max(Radius + spheres[0].Radius, (from - spheres[0].Centre).Length);
            Near(spheres[0].Centre + ((from - spheres[0].Centre).Direction * reach), place, 1e-14);
        }

        Assert.True(found > 300, $"{found}");
    }

    /// <summary>A wedge has a place as long as its planes can be told from parallel ones.</summary>
    [Theory]
    [InlineData(1e-2, true)]
    [InlineData(1e-4, true)]
    [InlineData(1e-5, true)]
    [InlineData(1.1e-6, true)]
    [InlineData(0.9e-6, false)]
    public void Place_BehindAWedgeThatIsAllButFlat_IsFarAwayOrNone(double sine, bool isFound)
    {
        StaticPlane[] wedge = [new StaticPlane("floor", V(0, 1), 0, 0, 0), new StaticPlane("wall", V(sine, -1).Direction, 0, 0, 0)];
        Assert.Equal(isFound, new NearestPlace(new StaticSurfaces(wedge, [])).TryFind(V(-1, 0), Radius, default, out Vector3D place));
        Assert.True(!isFound || Math.Abs((place.X * sine / (Radius * (1 + Math.Sqrt(1 + (sine * sine))))) - 1) < 1e-9);
    }

    [Fact]
    public void Place_BetweenPlanesTooClose_IsNone() => Assert.False(new NearestPlace(
        new StaticSurfaces([new StaticPlane("a", V(1), 0, 0, 0), new StaticPlane("b", V(-1), -0.4, 0, 0)], [])).TryFind(V(0.2), Radius, default, out _));

    private static Vector3D Direction(Random random) => V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5).Direction;

    private static Vector3D Projected(StaticPlane[] planes, in Vector3D from, bool corrects)
    {
        Vector3D at = from;
        Vector3D[] corrections = new Vector3D[planes.Length];
        for (int n = 0; n < 100_000; n++)
        {
            Vector3D before = at;
            for (int i = 0; i < planes.Length; i++)
            {
                Vector3D tried = at + corrections[i];
                at = tried - (planes[i].Normal * Math.Min(0, planes[i].Gap(tried, Radius)));
                corrections[i] = corrects ? tried - at : default;
            }

            if (n > 20_000 && (at - before).Length < 1e-14)
            {
                break;
            }
        }

        return at;
    }
}
