using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Islands: bodies in lasting contact with each other, or with what no closed form carries them on. They move by steps that are taken for all
/// together, and rest together.</content>
/// <remarks>
/// All of an island open their pieces of path with one key, and whatever opens a new piece for one opens one for all. So a timeline that is cut cuts them all,
/// and healing needs to know nothing else of them. Who is in an island with whom is told by the pieces: opened by one event, and touching there (<see
/// cref="Lasts(int, int, int, int)"/>).
/// </remarks>
public sealed partial class Simulation
{
    /// <summary>With friction an island rests if what pulls at it moves it by less than this part of that: so much the solver leaves.</summary>
    private const double Unsettled = 1e-6;

    private IslandStep island;
    private int[] group = Array.Empty<int>(); // by party: the least party that it is in contact with, through others as well
    private bool[] needsSteps = Array.Empty<bool>(); // by least party of a group
    private bool[] isMember = Array.Empty<bool>(); // of those that are grouped
    private bool[] isOpened = Array.Empty<bool>();
    private int[] numbers = Array.Empty<int>(); // by party: its number in the step at hand, or -1
    private int[] fellows = Array.Empty<int>(); // by number in the step at hand: the party
    private ContactPoint[] touching = Array.Empty<ContactPoint>(); // of the parties at hand what touches
    private int[] stepContacts = Array.Empty<int>(); // by contact in the step at hand: its number among those
    private int touchingCount;

    /// <summary>Takes no contact for one that lasts: only a test's negative control sets it.</summary>
    internal bool IgnoresIslands { get; set; }

    /// <summary>Takes no step of an island anew, however deep bodies get on the way: only a test's negative control sets it, before it advances.</summary>
    internal bool MayBeDeep
    {
        get => island.MayBeDeep;
        set => island.MayBeDeep = value;
    }

    /// <summary>
    /// Opens the next pieces of those parties that are in islands from here on. The states hold <paramref name="carry"/> seconds before the key's tick. Who is
    /// in none is not opened.
    /// </summary>
    private void OpenIslands(in EventKey key, double carry, bool mayRest)
    {
        GrowGroups();
        Array.Clear(isOpened, 0, partyCount);
        FindTouching(carry);

        // What touches is stepped together to see what pushes; and of the bodies that push each other those that touch are an island.
        GroupAllThatTouches();
        int stepped = 0;
        for (int least = 0; least < partyCount; least++)
        {
            if (group[least] == least && needsSteps[least])
            {
                StepGroup(least, carry, key.Time);
                stepped = island.BodyCount;
                for (int k = 0; k < island.ContactCount; k++)
                {
                    touching[stepContacts[k]].Pushes |= island.Pushes(k);
                }
            }
        }

        if (stepped == 0)
        {
            return;
        }

        Group(byPush: true);
        for (int i = 0; i < partyCount; i++)
        {
            isMember[i] = needsSteps[group[i]];
        }

        Group(byPush: false);
        for (int least = 0; least < partyCount; least++)
        {
            if (group[least] == least && isMember[least])
            {
                OpenIsland(key, least, carry, mayRest, stepped);
                stepped = 0;
            }
        }
    }

    private void GroupAllThatTouches()
    {
        Array.Fill(isMember, true, 0, partyCount);
        Group(byPush: false);
    }

    /// <summary>
    /// All that touches among the parties at hand, and with static surfaces, at the tick, whether it lasts or not: what opens may close again within a step.
    /// </summary>
    private void FindTouching(double carry)
    {
        touchingCount = 0;
        for (int i = 0; i < partyCount; i++)
        {
            if (double.IsPositiveInfinity(partyMasses[i]))
            {
                continue; // a hand goes its own way, so nothing lasts on it
            }

            Vector3D place = PlaceOf(i, carry);
            for (int surface = 0; surface < Scene.PlaneArray.Length + Scene.SphereArray.Length; surface++)
            {
                if (IsNear(place, surface, partyRadii[i]))
                {
                    AddTouching(new ContactPoint(i, ContactPoint.Static, surface, default));
                }
            }

            for (int j = i + 1; j < partyCount; j++)
            {
                if (!double.IsPositiveInfinity(partyMasses[j]) && AreNear(place, PlaceOf(j, carry), partyRadii[i] + partyRadii[j]))
                {
                    AddTouching(new ContactPoint(i, j, -1, default));
                }
            }
        }
    }

    private void AddTouching(in ContactPoint contact)
    {
        if (touchingCount == touching.Length)
        {
            Array.Resize(ref touching, Math.Max(8, touchingCount * 2));
            Array.Resize(ref stepContacts, touching.Length);
        }

        touching[touchingCount] = contact;
        touching[touchingCount].IsStruck = IsPressed(contact);
        touching[touchingCount].Pushes = touching[touchingCount].IsStruck;
        touchingCount++;
    }

    /// <summary>
    /// Whether a contact has just been struck that is pressed together and so will last. It is kept for a step even if over the whole of that it does not push:
    /// else it would be struck again and again for as long as it does.
    /// </summary>
    private bool IsPressed(in ContactPoint contact)
    {
        bool isPressed = false;
        for (int i = 0; i < contactCount && !isPressed; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            isPressed = c.Pushes && c.IsStruck && c.First == contact.First && c.Second == contact.Second && c.Surface == contact.Surface;
        }

        return isPressed;
    }

    /// <summary>Where a party is at the tick.</summary>
    private Vector3D PlaceOf(int party, double carry) =>
        (carry == 0 ? partyPositions[party] : partyPositions[party] + (partyVelocities[party] * carry)).WithoutNegativeZero();

    /// <summary>
    /// Whether no closed form carries a body on this contact: it is with another body or a static sphere, under forces, or one of several with friction.
    /// </summary>
    private bool NeedsSteps(in ContactPoint c, bool byPush)
    {
        if (!IsSupportable(c))
        {
            return true;
        }

        bool isOneOfSeveral = false;
        for (int i = 0; i < touchingCount && Friction(c) > 0 && !isOneOfSeveral; i++)
        {
            ref readonly ContactPoint other = ref touching[i];
            isOneOfSeveral = (other.Pushes || c.IsStruck || !byPush) && other.First == c.First && other.Second == ContactPoint.Static && other.Surface != c.Surface;
        }

        return isOneOfSeveral;
    }

    /// <summary>Groups the members among the parties by what touches, or pushes, each group named by its least, and tells which of them need steps.</summary>
    private void Group(bool byPush)
    {
        for (int i = 0; i < partyCount; i++)
        {
            group[i] = i;
            needsSteps[i] = false;
        }

        for (int i = 0; i < touchingCount; i++)
        {
            ref readonly ContactPoint c = ref touching[i];
            if (c.Second == ContactPoint.Static || (byPush && !c.Pushes) || !isMember[c.First] || !isMember[c.Second])
            {
                continue;
            }

            int from = Math.Max(group[c.First], group[c.Second]);
            int to = Math.Min(group[c.First], group[c.Second]);
            for (int party = 0; party < partyCount && from != to; party++)
            {
                group[party] = group[party] == from ? to : group[party];
            }
        }

        for (int i = 0; i < touchingCount; i++)
        {
            ref readonly ContactPoint c = ref touching[i];
            needsSteps[group[c.First]] |= (c.Pushes || !byPush) && isMember[c.First] && NeedsSteps(c, byPush);
        }
    }

    /// <summary>Takes the step of a group of parties, with all that touches among them.</summary>
    private void StepGroup(int least, double carry, SimTime time)
    {
        FillStep(island, least, carry);
        if (stepsAhead is null || !stepsAhead.TryUse(ref island, time))
        {
            island.Take(time, LastingSpeed);
        }
    }

    private void FillStep(IslandStep step, int least, double carry)
    {
        step.Clear();
        for (int i = 0; i < partyCount; i++)
        {
            numbers[i] = -1;
            if (group[i] == least)
            {
                numbers[i] = step.AddBody(
                    bodies[parties[i]].Id, bodies[parties[i]].Spec, PlaceOf(i, carry), partyVelocities[i].WithoutNegativeZero(),
                    partySpins[i].WithoutNegativeZero());
                fellows[numbers[i]] = i;
            }
        }

        for (int i = 0; i < touchingCount; i++)
        {
            ref readonly ContactPoint c = ref touching[i];
            if (numbers[c.First] >= 0 && (c.Second == ContactPoint.Static || numbers[c.Second] >= 0))
            {
                stepContacts[step.ContactCount] = i;
                step.AddContact(numbers[c.First], c.Second == ContactPoint.Static ? ContactPoint.Static : numbers[c.Second], c.Surface, Friction(c), RollingLever(c));
            }
        }
    }

    private void OpenIsland(in EventKey key, int least, double carry, bool mayRest, int stepped)
    {
        int size = 0;
        for (int i = 0; i < partyCount; i++)
        {
            size += group[i] == least ? 1 : 0;
        }

        if (size != stepped || group[fellows[0]] != least)
        {
            StepGroup(least, carry, key.Time);
        }

        bool rests = mayRest && AreSlow();
        if (rests)
        {
            island.TakeFromRest(key.Time);
            rests = StaysAtRest();
            if (!rests)
            {
                island.Take(key.Time, LastingSpeed);
            }
        }

        if (!rests)
        {
            NoteOpened(parties[fellows[0]]);
        }

        for (int n = 0; n < island.BodyCount; n++)
        {
            int party = fellows[n];
            int slot = parties[party];
            isOpened[party] = true;
            if (rests)
            {
                bool turns = island.EndSpin(n).Length * partyRadii[party] > Unsettled * island.Length.ToSeconds() * island.Pull() || !island.Rubs;
                Append(slot, key, MotionSegment.AtRest(key.Time, PlaceOf(party, carry)), default, spin: turns ? new Spin(partySpins[party]) : default);
                continue;
            }

            double rate = island.RateNotFollowed(n);
            if (rate > 0)
            {
                throw TooStiff(slot, key.Time, PlaceOf(party, carry), partyVelocities[party], partySpins[party], rate);
            }

            int crowding = key.Kind == EventKind.Impact ? CrowdingAt(slot, key.Time) : 0;
            MotionSegment path = island.PathOf(n, key.Time, crowding, out DenseOutput dense, out Spin spin);
            CheckState(slot, key, path.Position, path.Velocity);
            Append(slot, key, path, dense, spin: spin);
        }
    }

    /// <summary>
    /// Whether nobody in the step at hand is faster than what rises less than the scene resolves, and no force on them depends on the time as far as anybody
    /// knows.
    /// </summary>
    private bool AreSlow()
    {
        bool isSlow = true;
        double limit = Math.Sqrt(2 * Scene.Resolution * island.Pull());
        for (int n = 0; n < island.BodyCount && isSlow; n++)
        {
            isSlow = partyVelocities[fellows[n]].Length <= limit && !forces.HasSupplied(bodies[parties[fellows[n]]].Spec);
        }

        return isSlow;
    }

    /// <summary>
    /// Whether nothing moves in the step that was taken from rest: without friction where gravity would pull as much if everything were displaced by the
    /// scene's resolution, with friction as far as the solver tells.
    /// </summary>
    private bool StaysAtRest()
    {
        bool rests = true;
        double speed = island.Length.ToSeconds() * island.Pull();
        for (int n = 0; n < island.BodyCount && rests; n++)
        {
            rests = island.Stir(n) <= speed * (island.Rubs ? Unsettled : Scene.Resolution / partyRadii[fellows[n]]);
        }

        return rests;
    }

    private void GrowGroups()
    {
        if (partyCount <= group.Length)
        {
            return;
        }

        int size = parties.Length;
        Array.Resize(ref group, size);
        Array.Resize(ref needsSteps, size);
        Array.Resize(ref isMember, size);
        Array.Resize(ref isOpened, size);
        Array.Resize(ref numbers, size);
        Array.Resize(ref fellows, size);
    }
}
