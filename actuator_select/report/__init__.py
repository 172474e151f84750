"""Design reports: results to figures and HTML. Nothing is computed here."""

from actuator_select.report.html import ReportDetails, render_report
from actuator_select.report.workspace_html import render_workspace_report

__all__ = ["ReportDetails", "render_report", "render_workspace_report"]
