using LagSim.Contacts;

namespace LagSim.Response;

/// <summary>
/// Leaves contacts out of an impact of bodies that lie inside one another, as out of their steps: each body keeps its deepest ones
/// (docs/CONTACT.md, rule 4).
/// </summary>
/// <remarks>What is with a surface or a hand stays, and so does what an impact is named by: each body's first pair of the round.</remarks>
internal sealed class ImpactCrowd(ContactGraph graph, SolverRules rules)
{
    private readonly DeepestContacts deepest = new();

    /// <summary>Leaves them out of the graph, whose states are known.</summary>
    internal void LeaveOut()
    {
        if (!rules.LimitsCrowds || !DeepestContacts.MayBeCrowd(graph.ContactCount, graph.BodyCount))
        {
            return;
        }

        deepest.Clear();
        foreach (ref readonly ContactPoint c in graph.Contacts)
        {
            if (c.Second != ContactPoint.Static)
            {
                deepest.Add(c.First, c.Second, graph.GapOf(c));
            }
        }

        if (!deepest.IsCrowd(graph.BodyCount))
        {
            return;
        }

        deepest.Choose(graph.BodyCount);
        int kept = 0;
        int pair = 0;
        int named = -1;
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            bool isPair = c.Second != ContactPoint.Static;
            bool names = isPair && !c.IsFromBefore && c.First != named;
            named = names ? c.First : named;
            bool isKept = !isPair || deepest.IsKept(pair) || names || graph.IsByHand(c);
            pair += isPair ? 1 : 0;
            if (isKept)
            {
                graph.Move(i, kept++);
            }
        }

        graph.KeepContacts(kept);
    }
}
