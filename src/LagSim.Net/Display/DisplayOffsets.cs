using System;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Display;

/// <summary>
/// Smooths the visible jumps that late events cause: the world is always exact, and each body is drawn with an offset from it that decays.
/// </summary>
/// <remarks>
/// <para>Call <see cref="Update"/> once a frame with the newest render snapshot and the frame's time, then <see cref="TryRead"/> for each
/// body to draw. For display only: what is drawn differs from peer to peer and must never enter a simulation.</para>
/// <para>A correction is the difference between where the body was shown at the previous frame's time and where the new render snapshot has
/// it at that same time. So motion causes none, however fast, nor does a player's current action; only a rewritten past does. The
/// correction is added to the body's offset, and the offset decays exponentially, small ones faster (<see cref="DisplayOptions"/>), along
/// the same curve whatever the frame rate.</para>
/// <para>An offset is dropped at once if it would draw the body inside a plane, a static sphere or another body as drawn; if it is too
/// large to be smoothed; if the body is moved elsewhere; and as far as a bounce hides it.</para>
/// <para>For one world: make a new one when you join another. A frame costs two reads of the render snapshot per body, and for each body
/// with an offset a check against every other. Memory grows with the bodies of the render snapshot; otherwise nothing is allocated. Not
/// thread-safe: for the thread that reads render snapshots.</para>
/// </remarks>
/// <example>
/// Each frame:
/// <code>
/// DisplayOffsets display = new(me.Session.Scene!);
///
/// // each frame
/// if (me.Latest() is RenderSnapshot snapshot)
/// {
///     display.Update(snapshot, me.Session.DisplayTime);
/// }
///
/// if (display.TryRead(ball, out DrawnBody drawn))
/// {
///     Console.WriteLine($"drawn at {drawn.Position}, in truth at {drawn.State.Position}");
/// }
/// </code>
/// </example>
public sealed class DisplayOffsets
{
    private readonly Scene scene;
    private readonly DisplayOptions options;
    private readonly OwnHands hands = new();
    private DisplayedBody[] entries = Array.Empty<DisplayedBody>();
    private DisplayedBody[] spare = Array.Empty<DisplayedBody>();
    private int count;
    private RenderSnapshot? lastSnapshot;
    private long lastNumber;
    private SimTime lastTime;

    /// <summary>Creates offsets for render snapshots of a world of the scene; all zero to begin with.</summary>
    /// <param name="scene">The scene, with what bodies must not be drawn inside of.</param>
    /// <param name="options">How corrections are hidden; null for the defaults.</param>
    /// <exception cref="ArgumentNullException"><paramref name="scene"/> is null.</exception>
    public DisplayOffsets(Scene scene, DisplayOptions? options = null)
    {
        this.scene = scene ?? throw new ArgumentNullException(nameof(scene));
        this.options = options ?? new DisplayOptions();
    }

    /// <summary>How often late events have moved what was shown, counting each body.</summary>
    public long Corrections { get; private set; }

    /// <summary>The largest of these corrections, in metres.</summary>
    public double LargestJump { get; private set; }

    /// <summary>
    /// This player's own hand, which holds a body, is here now: as long as the world shows that he holds it, the body is drawn exactly where
    /// the hand has it, at every sample, while only keyframes travel.
    /// </summary>
    /// <param name="body">The body.</param>
    /// <param name="peer">This player's number, <see cref="Sessions.Session.Peer"/>: another's hold is not his.</param>
    /// <param name="position">Where the hand's point is, in metres: what a keyframe would say. The centre is drawn from there by the offset of
    /// the grab.</param>
    /// <remarks>For this player's display only: the body itself follows the keyframes, on this peer as on the others. When the hold ends it
    /// is drawn with the offset that is left, which decays as any other. Call it before or after <see cref="Update"/>, as often as
    /// samples come. Nothing is allocated after the first for a body.</remarks>
    /// <exception cref="ArgumentException">The position is not finite.</exception>
    public void SetHand(BodyId body, byte peer, Vector3D position)
    {
        if (!position.IsFinite)
        {
            throw new ArgumentException($"The hand that holds body {body} is at {position}; every component must be finite.", nameof(position));
        }

        hands.Set(new OwnHand(body, peer, position));
    }

    /// <summary>The hand holds the body no more: it is drawn from the world again. Needed only to end it before the world does.</summary>
    public void ClearHand(BodyId body) => hands.Clear(body);

    /// <summary>Begins a frame.</summary>
    /// <param name="snapshot">The newest render snapshot.</param>
    /// <param name="now">
    /// The time to show. If it is before that of the last frame, or the render snapshot is an older one, all offsets are reset.
    /// </param>
    /// <returns>False if the render snapshot does not cover that time; then nothing changed and bodies read as in the last frame.</returns>
    /// <exception cref="ArgumentNullException"><paramref name="snapshot"/> is null.</exception>
    public bool Update(RenderSnapshot snapshot, SimTime now)
    {
        if (snapshot is null)
        {
            throw new ArgumentNullException(nameof(snapshot));
        }

        if (!snapshot.Covers(now))
        {
            return false;
        }

        if (lastSnapshot is null || now < lastTime || snapshot.Number < lastNumber)
        {
            count = 0;
            lastTime = now;
        }

        bool isRewritten = snapshot != lastSnapshot || snapshot.Number != lastNumber;
        Follow(snapshot);
        for (int n = 0; n < count; n++)
        {
            Move(ref entries[n], snapshot, now, isRewritten);
        }

        while (DropWhatIsInside())
        {
            // A body whose offset was dropped is drawn elsewhere, where another's offset may now be too much.
        }

        lastSnapshot = snapshot;
        lastNumber = snapshot.Number;
        lastTime = now;
        return true;
    }

    /// <summary>Reads how to draw a body in this frame.</summary>
    /// <returns>False if the body is unknown or not there.</returns>
    public bool TryRead(BodyId body, out DrawnBody drawn)
    {
        int low = 0;
        int high = count;
        while (low < high)
        {
            int middle = (low + high) >> 1;
            if (entries[middle].Body < body)
            {
                low = middle + 1;
            }
            else
            {
                high = middle;
            }
        }

        bool isThere = low < count && entries[low].Body == body && entries[low].IsThere;
        drawn = !isThere ? default
            : entries[low].IsHeld && hands.TryFind(body, out OwnHand hand) && hand.Peer == entries[low].Holder
                ? new DrawnBody(entries[low].State, hand.Position - entries[low].HoldOffset)
                : entries[low].ToDrawn();
        return isThere;
    }

    /// <summary>Keeps one entry for each body of the render snapshot, in its order.</summary>
    private void Follow(RenderSnapshot snapshot)
    {
        int known = 0;
        while (known < count && known < snapshot.BodyCount && entries[known].Body == snapshot.BodyAt(known))
        {
            known++;
        }

        if (known == count && known == snapshot.BodyCount)
        {
            return;
        }

        if (spare.Length < snapshot.BodyCount)
        {
            spare = new DisplayedBody[Math.Max(snapshot.BodyCount, 2 * spare.Length)];
        }

        int old = 0;
        for (int n = 0; n < snapshot.BodyCount; n++)
        {
            BodyId body = snapshot.BodyAt(n);
            while (old < count && entries[old].Body < body)
            {
                old++;
            }

            spare[n] = old < count && entries[old].Body == body ? entries[old] : new DisplayedBody { Body = body };
        }

        (entries, spare) = (spare, entries);
        count = snapshot.BodyCount;
    }

    private void Move(ref DisplayedBody entry, RenderSnapshot snapshot, SimTime now, bool isRewritten)
    {
        entry.Jump = entry.Decay = entry.Dropped = 0;
        bool isThere = snapshot.TryRead(entry.Body, now, out BodyState state);
        if (!hands.AreNone && TryFollowHand(ref entry, snapshot, state, now))
        {
            return;
        }

        if (entry.IsThere && isThere)
        {
            if (isRewritten)
            {
                Correct(ref entry, snapshot);
            }

            if (entry.Size > 0)
            {
                Shrink(ref entry, snapshot, now);
            }
        }
        else
        {
            entry.Drop();
        }

        entry.IsThere = isThere;
        entry.State = state;
        entry.Radius = isThere ? snapshot.RadiusOf(entry.Body) : 0;
    }

    /// <summary>
    /// The body is in this player's own hand: its offset is what is between the two, so that it goes on from there when the hold ends. When
    /// the world shows that it has ended, the hand is forgotten.
    /// </summary>
    private bool TryFollowHand(ref DisplayedBody entry, RenderSnapshot snapshot, in BodyState state, SimTime now)
    {
        bool was = entry.IsHeld;
        entry.IsHeld = false;
        if (!hands.TryFind(entry.Body, out OwnHand hand))
        {
            return false;
        }

        if (!snapshot.TryReadHold(entry.Body, now, out Hold hold) || hold.Peer != hand.Peer)
        {
            if (was)
            {
                EndHand(ref entry, hand, snapshot, state);
            }

            return was;
        }

        entry.IsHeld = true;
        entry.Holder = hold.Peer;
        entry.HoldOffset = hold.Offset;
        entry.Take(state, snapshot.RadiusOf(entry.Body), Vector3D.Zero);
        return true;
    }

    /// <summary>The world shows that the hold has ended: the body goes on from where the hand had it, with an offset that decays.</summary>
    private void EndHand(ref DisplayedBody entry, in OwnHand hand, RenderSnapshot snapshot, in BodyState state)
    {
        hands.Clear(entry.Body);
        bool isThere = state.Motion != MotionLaw.Absent;
        Vector3D offset = isThere ? scene.Box.Nearest(hand.Position - entry.HoldOffset - state.Position) : Vector3D.Zero;
        entry.Take(state, isThere ? snapshot.RadiusOf(entry.Body) : 0, offset);
        entry.IsThere = isThere;
        entry.TimeConstant = OffsetDecay.TimeConstant(options, entry.Size);
        if (entry.Size > options.SnapDistance)
        {
            entry.Drop();
        }
    }

    /// <summary>Compares the new render snapshot at the last frame's time with what was shown then.</summary>
    private void Correct(ref DisplayedBody entry, RenderSnapshot snapshot)
    {
        if (!snapshot.TryRead(entry.Body, lastTime, out BodyState then))
        {
            entry.Drop(); // it was not there after all, or frames are further apart than render snapshots reach back
            return;
        }

        Vector3D change = scene.Box.Nearest(entry.State.Position - then.Position);
        entry.Jump = change.Length;
        if (entry.Jump == 0)
        {
            return;
        }

        Corrections++;
        LargestJump = Math.Max(LargestJump, entry.Jump);
        entry.Offset += change;
        entry.Size = entry.Offset.Length;
        entry.TimeConstant = OffsetDecay.TimeConstant(options, entry.Size);
        if (entry.Size > options.SnapDistance)
        {
            entry.Drop();
        }
    }

    private void Shrink(ref DisplayedBody entry, RenderSnapshot snapshot, SimTime now)
    {
        double left = OffsetDecay.After(entry.Size, entry.TimeConstant, options.MaxSpeed, (now - lastTime).ToSeconds());
        entry.Decay = entry.Size - left;
        entry.ShrinkTo(left);
        snapshot.TryReadSuddenChange(entry.Body, lastTime, now, out double change);
        double hidden = change < double.PositiveInfinity ? Math.Min(change * options.Hiding.ToSeconds(), entry.Size) : entry.Size;
        entry.Dropped += hidden;
        entry.ShrinkTo(entry.Size - hidden);
    }

    private bool DropWhatIsInside()
    {
        bool isDropped = false;
        for (int n = 0; n < count; n++)
        {
            if (entries[n].Size > 0 && (IsInsideStatic(entries[n]) || IsInsideBody(n)))
            {
                entries[n].Drop();
                isDropped = true;
            }
        }

        return isDropped;
    }

    private bool IsInsideStatic(in DisplayedBody entry)
    {
        Vector3D drawn = entry.State.Position + entry.Offset;
        for (int i = 0; i < scene.Planes.Count; i++)
        {
            StaticPlane plane = scene.Planes[i];
            if (entry.State.Filter.CollidesWith(plane.Filter) && IsDeeper(plane.Gap(drawn, entry.Radius), plane.Gap(entry.State.Position, entry.Radius)))
            {
                return true;
            }
        }

        for (int i = 0; i < scene.StaticSpheres.Count; i++)
        {
            StaticSphere sphere = scene.StaticSpheres[i];
            double touching = sphere.Radius + entry.Radius;
            if (entry.State.Filter.CollidesWith(sphere.Filter)
                && IsDeeper((drawn - sphere.Centre).Length - touching, (entry.State.Position - sphere.Centre).Length - touching))
            {
                return true;
            }
        }

        return false;
    }

    private bool IsInsideBody(int n)
    {
        ref readonly DisplayedBody entry = ref entries[n];
        Vector3D drawn = entry.State.Position + entry.Offset;
        for (int other = 0; other < count; other++)
        {
            ref readonly DisplayedBody partner = ref entries[other];
            double touching = entry.Radius + partner.Radius;
            if (other != n && partner.IsThere && entry.State.Filter.CollidesWith(partner.State.Filter)
                && IsDeeper(
                    scene.Box.Nearest(drawn - partner.State.Position - partner.Offset).Length - touching,
                    scene.Box.Nearest(entry.State.Position - partner.State.Position).Length - touching))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Whether the offset is to blame for a penetration.</summary>
    private bool IsDeeper(double drawn, double real) => drawn < Math.Min(real, 0) - options.Penetration;
}
