using LagSim.Events;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What collision filters let pass, and what comes of a body whose filter changes.</summary>
public sealed class FilterTests
{
    private static readonly CollisionFilter Ghost = new(2, 1); // meets what has the default, and not its like

    [Theory]
    [InlineData(1u, uint.MaxValue, 1u, uint.MaxValue, true)]
    [InlineData(2u, uint.MaxValue, 4u, uint.MaxValue, true)]
    [InlineData(2u, 1u, 2u, 1u, false)]
    [InlineData(2u, 4u, 4u, 2u, true)]
    [InlineData(2u, 4u, 4u, 8u, false)] // one side is not enough
    [InlineData(0u, uint.MaxValue, 1u, uint.MaxValue, false)]
    [InlineData(1u, 0u, 1u, uint.MaxValue, false)]
    [InlineData(0x80000000u, 0x80000000u, 0x80000001u, 0x80000000u, true)]
    public void CollidesWith_CategoriesAndMasks_AsInBox2D(uint category, uint mask, uint otherCategory, uint otherMask, bool collides)
    {
        CollisionFilter filter = new(category, mask), other = new(otherCategory, otherMask);
        Assert.Equal(collides, filter.CollidesWith(other));
        Assert.Equal(collides, other.CollidesWith(filter));
        Assert.Equal((category, mask), (filter.Category, filter.Mask));
    }

    [Fact]
    public void Default_IsCategoryOneAndEveryMask()
    {
        Assert.Equal(default, new CollisionFilter(1, uint.MaxValue));
        Assert.True(default(CollisionFilter).IsDefault);
        Assert.Equal((1u, uint.MaxValue), (default(CollisionFilter).Category, default(CollisionFilter).Mask));
        Assert.NotEqual(default, new CollisionFilter(2));
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Bodies_ThatMeet_PassThroughEachOtherIfTheirFiltersSaySo(bool areGhosts)
    {
        BodySpec ball = areGhosts ? Ball().With(Ghost) : Ball();
        Simulation world = Run(
            new SceneBuilder("scene").WithGravity(Floating).AddBody("a", ball, V(-2), V(1)).AddBody("b", ball, V(2), V(-1)).Build(), 4);
        Assert.Equal(areGhosts ? 0 : 1, world.ImpactsProcessed);
        Near(V(areGhosts ? 2 : -2 + 1.5 - 2.5), Read(world, First, 4).Position, 1e-12);
    }

    [Fact]
    public void Surfaces_OnlyStopWhatCollidesWithThem_AndTheBuilderLetsThemOverlap()
    {
        CollisionFilter air = new(2, 2);
        Scene scene = new SceneBuilder("scene").WithGravity(Floating)
            .AddPlane("wall", V(-1), V(3), filter: new CollisionFilter(1, 1))
            .AddStaticSphere("stone", V(-3), 0.5, filter: new CollisionFilter(4, 4))
            .AddBody("stopped", Ball(), V(0), V(1))
            .AddBody("inside all", Ball().With(air), V(0.1), V(1))
            .AddBody("in the wall", Ball().With(air), V(9, 3))
            .AddBody("to the stone", Ball().With(new CollisionFilter(4, 4)), V(0, 0, 0), V(-1))
            .Build();
        Simulation world = Run(scene, 5);
        Near(V(-1 + 1, 0), Read(world, First, 5).Position, 1e-12); // 2.5 m there and back
        Near(V(5.1), Read(world, Second, 5).Position, 1e-12);
        Near(V(1), Read(world, BodyId.OfScene(3), 5).Position, 1e-12); // 2 m there and 3 back
    }

    [Fact]
    public void Build_BodiesThatCollideInsideEachOther_AreRefusedAndOthersAreNot()
    {
        static SceneBuilder Two(CollisionFilter filter) => new SceneBuilder("scene")
            .AddBody("a", Ball().With(filter), V(0)).AddBody("b", Ball().With(filter), V(0.5));
        Assert.Throws<SceneException>(() => Two(default).Build());
        Assert.NotNull(Two(Ghost).Build());
        SceneBuilder floor = new SceneBuilder("scene").AddPlane("floor", Vector3D.Up, 0, filter: new CollisionFilter(1, 1));
        Assert.NotNull(floor.AddBody("under", Ball().With(new CollisionFilter(2)), V(0, -3)).Build());
        Assert.Throws<SceneException>(() => floor.AddBody("stuck", Ball(), V(9, 0)).Build());
    }

    /// <summary>By a closed form, on a static sphere by contact steps, and in a heap.</summary>
    [Theory]
    [InlineData(false, 0.0)]
    [InlineData(false, 0.5)]
    [InlineData(true, 0.0)]
    [InlineData(true, 0.5)]
    public void SetFilter_OfABodyAtRest_FallsThroughWhatCarriedIt(bool onSphere, double friction)
    {
        SceneBuilder builder = new("scene");
        _ = onSphere ? builder.AddStaticSphere("dome", V(0, -5), 5, 0.5) : builder.AddPlane("floor", Vector3D.Up, 0, 0.5);
        BodySpec spec = new(0.5, 1, 0.5, friction: friction);
        Scene scene = builder.AddBody("a", spec, V(0, 0.5)).AddBody("b", spec, V(0, 1.5)).Build();
        Simulation world = Run(scene, 4, [ExternalEvent.SetFilter(At(2), 1, 1, First, CollisionFilter.None)]);
        Near(0.5, Read(world, First, 2).Position.Y, 0.01);
        double fallen = 0.5 * Gravity * 2 * 2;
        Near(0.5 - fallen, Read(world, First, 4).Position.Y, 0.05);
        Near(0.5, Read(world, Second, 4).Position.Y, 0.01); // what lay on it comes down to what carried it
        Assert.Equal(CollisionFilter.None, Read(world, First, 2).Filter);
        Assert.True(Read(world, First, 1.999).Filter.IsDefault);
    }

    [Fact]
    public void SetFilter_OfABodyInsideAPlaneItCollidesWithNow_PutsItAtTheSurface()
    {
        Scene scene = new SceneBuilder("scene").AddPlane("floor", Vector3D.Up, 0, 0.5).AddBody("a", Ball(e: 0.5).With(CollisionFilter.None), V(0, 1)).Build();
        Simulation world = Run(scene, 5, [ExternalEvent.SetFilter(At(1), 1, 1, First, default)]);
        Assert.True(Read(world, First, 0.99).Position.Y < -3);
        Near(0.5, Read(world, First, 1).Position.Y, 1e-9);
        Near(0.5, Read(world, First, 5).Position.Y, 1e-3);
    }

    [Theory]
    [InlineData(0.5)]
    [InlineData(0.0)]
    public void SetFilter_OfABodyAtRestInsideAnother_PushesThemApart(double friction)
    {
        BodySpec spec = new(0.5, 1, 0.2, friction: friction);
        Scene scene = new SceneBuilder("scene").AddPlane("floor", Vector3D.Up, 0, 0.2)
            .AddBody("a", spec.With(Ghost), V(0, 0.5)).AddBody("b", spec.With(Ghost), V(0.6, 0.5)).Build();
        Assert.True(MinGap(Run(scene, 4), At(4)) < -0.3);
        Simulation world = Run(scene, 8, [ExternalEvent.SetFilter(At(2), 1, 1, First, default)]);
        Assert.True(MinGap(world, At(8)) > -2e-3, $"{MinGap(world, At(8))}"); // as slowly as two of which one was put into the other
    }

    [Fact]
    public void SetFilter_ToTheFilterItHas_ChangesNothing()
    {
        Scene scene = Drop(2, 0.5);
        ExternalEvent same = ExternalEvent.SetFilter(At(1), 1, 1, First, default);
        Simulation world = Run(scene, 3, [same]);
        Assert.False(world.TookEffect(same));
        Assert.Equal(Run(scene, 3).EventHash(At(3)), world.EventHash(At(3)));
    }

    [Fact]
    public void SetFilter_OfAHeldBody_LeavesItInItsHand()
    {
        Scene scene = new SceneBuilder("scene").WithGravity(Floating).AddBody("a", Ball(), V(0)).AddBody("b", Ball(), V(3)).Build();
        ExternalEvent[] hand =
        [
            ExternalEvent.Grab(At(0), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.1), 1, 2, First, V(0), V(10)),
            ExternalEvent.SetFilter(At(0.2), 1, 3, First, CollisionFilter.None),
            ExternalEvent.HoldKeyframe(At(0.4), 1, 4, First, V(4), V(10)), ExternalEvent.HoldKeyframe(At(0.6), 1, 5, First, V(6), V(0)),
        ];
        Simulation world = Run(scene, 0.9, hand);
        Assert.Equal(MotionLaw.Held, Read(world, First, 0.9).Motion);
        Near(V(3), Read(world, Second, 0.9).Position, 0); // it was in the way
        Assert.NotEqual(V(3), Read(Run(scene, 0.9, [hand[0], hand[1], hand[3], hand[4]]), Second, 0.9).Position);
    }

    [Fact]
    public void Remove_ThenSpawnAgain_HasTheFilterOfItsSpec()
    {
        Simulation world = new(new SceneBuilder("scene").WithGravity(Floating).WithSmallestRadius(0.5).Build(), KeepAll);
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball().With(Ghost).WithTag(0xFEDCBA9876543210), V(0));
        world.Submit(spawn);
        world.Submit(ExternalEvent.SetFilter(At(2), 1, 2, spawn.Body, new CollisionFilter(8, 8)));
        world.Submit(ExternalEvent.Remove(At(3), 1, 3, spawn.Body));
        world.AdvanceTo(At(4));
        Assert.Equal(Ghost, Read(world, spawn.Body, 1.5).Filter);
        Assert.Equal(new CollisionFilter(8, 8), Read(world, spawn.Body, 2.5).Filter);
        Assert.Equal(default, Read(world, spawn.Body, 3.5).Filter);
        Assert.Equal(0xFEDCBA9876543210, world.TagOf(spawn.Body));
    }

    [Fact]
    public void Hash_OfASceneWithAFilterOrATag_IsAnother()
    {
        static ulong Hash(CollisionFilter body, CollisionFilter plane, ulong tag) => new SceneBuilder("scene")
            .AddPlane("floor", Vector3D.Up, 0, filter: plane).AddBody("a", Ball().With(body).WithTag(tag), V(0, 5)).Build().Hash;
        ulong[] hashes = [Hash(default, default, 0), Hash(Ghost, default, 0), Hash(default, Ghost, 0), Hash(default, default, 1), Hash(Ghost, Ghost, 1)];
        Assert.Equal(hashes.Length, new System.Collections.Generic.HashSet<ulong>(hashes).Count);
        Assert.Equal(hashes[0], new SceneBuilder("other").AddPlane("floor", Vector3D.Up, 0).AddBody("a", Ball(), V(0, 5)).Build().Hash);
    }
}
