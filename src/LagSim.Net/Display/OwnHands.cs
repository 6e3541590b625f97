using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>Where this player's own hands are, by the body that each holds, or is about to.</summary>
internal sealed class OwnHands
{
    private readonly List<OwnHand> hands = new(); // one or two, as a rule

    /// <summary>Whether there is none.</summary>
    internal bool AreNone => hands.Count == 0;

    /// <summary>The newest sample of the hand that holds a body.</summary>
    internal void Set(in OwnHand hand)
    {
        int at = IndexOf(hand.Body);
        if (at < 0)
        {
            hands.Add(hand);
        }
        else
        {
            hands[at] = hand;
        }
    }

    /// <summary>No hand has to do with a body any more.</summary>
    internal void Clear(BodyId body)
    {
        int at = IndexOf(body);
        if (at >= 0)
        {
            hands.RemoveAt(at);
        }
    }

    internal bool TryFind(BodyId body, out OwnHand hand)
    {
        int at = IndexOf(body);
        hand = at < 0 ? default : hands[at];
        return at >= 0;
    }

    private int IndexOf(BodyId body)
    {
        int at = hands.Count - 1;
        while (at >= 0 && hands[at].Body != body)
        {
            at--;
        }

        return at;
    }
}
