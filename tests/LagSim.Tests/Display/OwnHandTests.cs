using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Display;

/// <summary>A body in one's own hand is drawn where the hand has it, to the bit, though keyframes come seldom.</summary>
public sealed class OwnHandTests
{
    private const byte Me = 1; // the peer of a screen's actions

    private static readonly Vector3D Offset = V(0.1, -0.2, 0.05);
    private static readonly Scene Scene = new SceneBuilder("hand").AddPlane("floor", Vector3D.Up, 0)
        .AddBody("puck", Ball(e: 0.5), V(0, 0.5)).AddBody("other", Ball(), V(9, 0.5)).Build();

    [Fact]
    public void SetHand_EverySample_IsWhereTheBodyIsDrawnAndTheWorldStaysAsItIs()
    {
        Screen screen = Grabbed();
        Screen without = Grabbed();
        double largest = 0;
        for (int n = 1; n <= 120; n++)
        {
            double now = 1 + (n / 120.0);
            Vector3D hand = Hand(now);
            if (n % 12 == 0)
            {
                PlayerAction keyframe = PlayerAction.HoldKeyframe(First, hand, V(3 * Math.Cos(3 * now)));
                screen.Do(now, keyframe);
                without.Do(now, keyframe);
            }

            screen.Offsets.SetHand(First, Me, hand);
            screen.Frame(now);
            without.Frame(now);
            DrawnBody drawn = screen.Drawn(First);
            Assert.True(drawn.IsInHand);
            Assert.Equal(hand - Offset, drawn.Position); // to the bit
            largest = Math.Max(largest, drawn.Offset.Length);
            screen.Offsets.SetHand(First, Me, hand + V(1e-9)); // a later sample of the same frame
            Assert.Equal(hand + V(1e-9) - Offset, screen.Drawn(First).Position);
            SameBits(without.Drawn(First).State, drawn.State);
        }

        Assert.True(largest > 0.05, $"{largest}"); // else there was nothing to hide
        Assert.Equal(without.World.StateHash(At(2)), screen.World.StateHash(At(2)));
    }

    [Fact]
    public void SetHand_OfABodyThatIsNotInThatHand_ChangesNothing()
    {
        Screen screen = Grabbed();
        screen.Offsets.SetHand(Second, Me, V(3, 3)); // nobody holds it
        screen.Offsets.SetHand(First, 2, V(3, 3)); // another holds this one
        screen.Frame(1.1);
        Assert.Equal(screen.Drawn(Second).State.Position, screen.Drawn(Second).Position);
        Assert.Equal(screen.Drawn(First).State.Position, screen.Drawn(First).Position);
        Assert.False(screen.Drawn(First).IsInHand);
        screen.Offsets.SetHand(First, Me, V(3, 3));
        screen.Offsets.ClearHand(First);
        screen.Frame(1.2);
        Assert.False(screen.Drawn(First).IsInHand);
        Assert.Throws<ArgumentException>(() => screen.Offsets.SetHand(First, Me, V(double.NaN)));
    }

    [Fact]
    public void Release_OfTheHand_GoesOnFromWhereItWasDrawn()
    {
        Screen screen = Grabbed();
        screen.Offsets.SetHand(First, Me, V(0.1, 1, 0.05));
        screen.Frame(1.1);
        DrawnBody held = screen.Drawn(First);
        screen.Do(1.1, PlayerAction.Release(First));
        screen.Frame(1.1 + (1 / 60.0));
        DrawnBody free = screen.Drawn(First);
        Assert.False(free.IsInHand);
        Assert.True((free.Position - held.Position).Length < 0.1, $"{free.Position} {held.Position}");
        Assert.True(free.Offset.Length > 0.1, $"{free.Offset}");
        for (int n = 2; n < 180; n++)
        {
            screen.Frame(1.1 + (n / 60.0));
        }

        Assert.True(screen.Drawn(First).Offset.Length < 1e-4, $"{screen.Drawn(First).Offset}");
    }

    [Fact]
    public void RenderSnapshot_TellsWhoHoldsAndThatAHoldEnded()
    {
        Screen screen = Grabbed();
        screen.Do(1.05, PlayerAction.HoldKeyframe(First, V(0.2, 0.4), V(0)));
        screen.Do(1.5, PlayerAction.Release(First));
        RenderSnapshot shown = screen.Publish(1.6);
        Assert.True(shown.TryReadHold(First, At(1.49), out Hold hold));
        Assert.Equal((Me, Offset, At(1.05)), (hold.Peer, hold.Offset, hold.KeyframeTime));
        Assert.False(shown.TryReadHold(First, At(1.5), out Hold none));
        Assert.Equal(default, none);
        Assert.False(shown.TryReadHold(Second, At(1.49), out _));
        Assert.False(shown.TryReadHold(First, At(9), out _));
        Assert.True(shown.TryReadHoldEnd(First, At(1.45), At(1.55), out Hold ended, out SimTime at));
        Assert.Equal((Me, At(1.5)), (ended.Peer, at));
        Assert.False(shown.TryReadHoldEnd(First, At(1.5), At(1.55), out _, out _));
        Assert.False(shown.TryReadHoldEnd(First, At(1.4), At(1.49), out _, out _));
        Assert.False(shown.TryReadHoldEnd(Second, At(1.45), At(1.55), out _, out _));
    }

    private static Vector3D Hand(double time) => V(Math.Sin(3 * (time - 1)), 0.5 + (0.3 * (time - 1)), 0.05) + Offset;

    private static Screen Grabbed()
    {
        Screen screen = new(Scene);
        screen.Frame(0.9);
        screen.Do(1, PlayerAction.Grab(First, Offset));
        screen.Frame(1);
        return screen;
    }
}
