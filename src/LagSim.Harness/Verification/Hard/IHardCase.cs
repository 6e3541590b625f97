using System.Collections.Generic;

namespace LagSim.Harness.Verification.Hard;

/// <summary>One hard case: what is checked, and wrong methods that the very same check must see fail.</summary>
public interface IHardCase
{
    /// <summary>The name on the command line, such as <c>elastic-bounce</c>.</summary>
    string Name { get; }

    /// <summary>What it is, in a line.</summary>
    string Title { get; }

    /// <summary>The engine against its reference, row by row, each as it is computed.</summary>
    IEnumerable<HardRow> Rows(HardContext context);

    /// <summary>The same checks of deliberately wrong methods or references; none may pass.</summary>
    IEnumerable<HardRow> Controls(HardContext context);
}
