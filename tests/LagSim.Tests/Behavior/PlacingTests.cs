using System;
using LagSim.Events;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Spawns and teleports to a place that is taken, and whom a spawned body belongs to.</summary>
public sealed class PlacingTests
{
    private static readonly Scene Two = new SceneBuilder("two").WithGravity(Floating).WithSmallestRadius(0.25)
        .AddBody("a", Ball(), V(0)).AddBody("b", Ball(), V(9)).Build();

    private static ExternalEvent Spawn(WhenOccupied occupied, Vector3D place, BodySpec? spec = null) =>
        ExternalEvent.Spawn(At(1), 1, 1, spec ?? Ball(0.25), place, whenOccupied: occupied);

    [Theory]
    [InlineData(WhenOccupied.Overlap, true)]
    [InlineData(WhenOccupied.Skip, false)]
    [InlineData(WhenOccupied.Beside, true)]
    public void Spawn_OntoABody_DoesWhatItSays(WhenOccupied occupied, bool tookEffect)
    {
        ExternalEvent spawn = Spawn(occupied, V(0.3));
        Simulation world = Run(Two, 2, [spawn]);
        Assert.Equal(tookEffect, world.TookEffect(spawn));
        BodyState there = Read(world, spawn.Body, At(1));
        Assert.Equal(tookEffect, there.Motion != MotionLaw.Absent);
        if (occupied == WhenOccupied.Beside)
        {
            Assert.True(there.Position.Length >= 0.75 - 1e-9 && there.Position.Y == 0, $"{there.Position}"); // beside it, not above
            Assert.True((there.Position - V(0.3)).Length <= 1, $"{there.Position}");
        }
        else if (tookEffect)
        {
            Assert.Equal(V(0.3), there.Position);
        }
    }

    [Theory]
    [InlineData(WhenOccupied.Skip)]
    [InlineData(WhenOccupied.Beside)]
    public void Spawn_WhereNobodyIsThatItCollidesWith_IsPutThere(WhenOccupied occupied)
    {
        Assert.Equal(V(0.75), Read(Run(Two, 2, [Spawn(occupied, V(0.75))]), new BodyId(1, 1, 0), 1).Position); // touching
        ExternalEvent ghost = Spawn(occupied, V(0.1), Ball(0.25).With(CollisionFilter.None));
        Assert.Equal(V(0.1), Read(Run(Two, 2, [ghost]), ghost.Body, 1).Position);
    }

    [Theory]
    [InlineData(WhenOccupied.Skip, 9.0)]
    [InlineData(WhenOccupied.Overlap, 0.5)]
    public void Teleport_OntoABody_DoesWhatItSays(WhenOccupied occupied, double x)
    {
        ExternalEvent put = ExternalEvent.Teleport(At(1), 1, 1, Second, V(0.5), default, occupied);
        Simulation world = Run(Two, 1, [put]);
        Assert.Equal(occupied != WhenOccupied.Skip, world.TookEffect(put));
        Near(V(x), Read(world, Second, 1).Position, 0);
    }

    [Fact]
    public void Beside_AmongWallsAndBodies_IsInsideOfNothing()
    {
        SceneBuilder builder = new SceneBuilder("full").AddPlane("floor", Vector3D.Up, 0).AddPlane("wall", V(1), -0.6)
            .AddStaticSphere("stone", V(2, 0.5), 0.5).WithSmallestRadius(0.2);
        for (int n = 0; n < 5; n++)
        {
            builder.AddBody($"ball {n}", Ball(e: 0), V(0, 0.5 + n));
        }

        Simulation world = Run(builder.Build(), 1, [Spawn(WhenOccupied.Beside, V(0, 0.5), Ball(0.4))]);
        Assert.True(world.TookEffect(Spawn(WhenOccupied.Beside, V(0, 0.5), Ball(0.4))));
        Assert.True(MinGap(world, At(1)) > -1e-6, $"{MinGap(world, At(1))}");
    }

    [Fact]
    public void Beside_WithoutAnyRoomNear_DoesNothing()
    {
        Scene scene = new SceneBuilder("huge").WithGravity(Floating).WithSmallestRadius(0.1).AddBody("a", Ball(100), V(0)).Build();
        ExternalEvent spawn = Spawn(WhenOccupied.Beside, V(3), Ball(0.1));
        Assert.False(Run(scene, 2, [spawn]).TookEffect(spawn));
    }

    /// <summary>A body comes late into the place of a spawn, and then is found never to have come.</summary>
    [Fact]
    public void Skip_OfWhichALateEventChangesTheAnswer_IsReversedAndBack()
    {
        ExternalEvent spawn = Spawn(WhenOccupied.Skip, V(4));
        ExternalEvent comes = ExternalEvent.SetVelocity(At(0.5), 2, 1, First, V(8)); // it is at the place at 1 s
        ExternalEvent newcomer = ExternalEvent.Spawn(At(0.25), 3, 1, Ball(), V(4));
        Simulation world = new(Two, KeepAll);
        world.Submit(spawn);
        world.AdvanceTo(At(3));
        Assert.True(world.TookEffect(spawn));
        foreach (ExternalEvent late in new[] { comes, newcomer })
        {
            world.Submit(late);
            world.AdvanceTo(At(3));
            Assert.False(world.TookEffect(spawn));
            Assert.Equal(Run(Two, 3, [spawn, late]).EventHash(At(3)), world.EventHash(At(3)));
            world.Retract(late);
            world.AdvanceTo(At(3));
            Assert.True(world.TookEffect(spawn));
            Assert.Equal(Run(Two, 3, [spawn]).EventHash(At(3)), world.EventHash(At(3)));
        }
    }

    [Fact]
    public void Submit_WithAnUnknownWord_IsRefusedWithASentence() => Assert.Contains(
        "is 3; it must be Overlap (put it there), Skip (do nothing) or Beside (put it beside)",
        Assert.Throws<SceneException>(() => new Simulation(Two, KeepAll).Submit(Spawn((WhenOccupied)3, V(3)))).Message, StringComparison.Ordinal);

    [Fact]
    public void Spawn_ThatBelongsToSome_IsTouchedByThemAlone()
    {
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball(), V(4), players: PeerSet.Of(1, 3));
        ExternalEvent Push(byte peer, double at) => ExternalEvent.SetVelocity(At(at), peer, 9, spawn.Body, V(0, peer));
        Simulation world = Run(Two, 5, [spawn, Push(2, 1.5), Push(3, 2), Push(0, 2.5), ExternalEvent.Remove(At(3), 2, 10, spawn.Body), ExternalEvent.Remove(At(4), 0, 10, spawn.Body)]);
        Assert.Equal((false, true, false), (world.TookEffect(Push(2, 1.5)), world.TookEffect(Push(3, 2)), world.TookEffect(Push(0, 2.5))));
        Assert.Equal(V(0, 3), Read(world, spawn.Body, 3.5).Velocity);
        Assert.Equal(MotionLaw.Absent, Read(world, spawn.Body, 4).Motion); // the host clears up
        Assert.Equal(PeerSet.Of(1, 3), world.PlayersOf(spawn.Body));
        Simulation continued = new(Two, world.Snapshot(At(1.25)), KeepAll);
        continued.Submit(Push(2, 1.5));
        continued.AdvanceTo(At(2));
        Assert.Equal(V(0), Read(continued, spawn.Body, 2).Velocity);
        Assert.Equal(PeerSet.Of(1, 3), continued.PlayersOf(spawn.Body));
    }
}
